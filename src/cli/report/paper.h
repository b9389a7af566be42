#pragma once

#include <array>
#include <string_view>

namespace mimicry::cli {

/// A measure of the paper's table under one task.
struct PaperFigure {
  double spraycan, spraycan_sd, mimicry, mimicry_sd, z;
  std::string_view p;  ///< as printed
};

/// A row of the paper's table (section 6.4), and how the measure is written.
struct PaperMeasure {
  std::string_view column;  ///< of our tables
  std::string_view html;    ///< "D<sub>ep</sub>"
  std::string_view title;   ///< with its unit, plain
  std::string_view unit;
  PaperFigure tracing, re_creating;
};

const std::array<PaperMeasure, 10>& paper_table();
/// nullptr for a column that is none of the paper's measures.
const PaperMeasure* paper_measure(std::string_view column);

inline constexpr int kPaperTracingPairs = 539;
inline constexpr int kPaperReCreatingPairs = 564;

}  // namespace mimicry::cli
