#pragma once

#include <string_view>

namespace mimicry::cli {

/// How a measure of the paper's table is written.
struct MeasureText {
  std::string_view column;  ///< of our tables
  std::string_view html;    ///< "D<sub>ep</sub>"
  std::string_view title;   ///< with its unit, plain
  std::string_view unit;
};

/// nullptr for a column that is none of the paper's measures.
const MeasureText* measure_text(std::string_view column);

}  // namespace mimicry::cli
