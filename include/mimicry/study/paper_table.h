#pragma once

#include <array>
#include <string_view>

#include <mimicry/study/comparison.h>
#include <mimicry/study/protocol.h>

namespace mimicry {

/// A measure under one task in the paper's table (section 6.4): spraycan first, as it prints it.
struct PaperFigure {
  double spraycan, spraycan_deviation, mimicry, mimicry_deviation;
  double z;            ///< > 0 where spraycan's values are larger
  std::string_view p;  ///< as printed: "<.001"
  bool significant;    ///< at .05
};

/// A row of the table. Measures are called as the columns of our tables are, in the same units.
struct PaperRow {
  std::string_view measure;
  PaperFigure tracing, re_creating;
};

/// The table's ten measures, in its order.
const std::array<PaperRow, 10>& paper_table();
/// nullptr for a measure that is none of the ten.
const PaperFigure* paper_figure(std::string_view measure, TaskKind task);

inline constexpr int kPaperTracingPairs = 539;
inline constexpr int kPaperReCreatingPairs = 564;

/// Part of the paper's mean by which ours may differ from it.
inline constexpr double kMeanTolerance = 0.25;
/// p below which a difference counts.
inline constexpr double kSignificance = 0.05;

/// Whether what was measured is what the paper found.
struct Agreement {
  bool spraycan_mean = false, mimicry_mean = false;  ///< within kMeanTolerance of the paper's
  bool sign = false;                                 ///< z has the paper's sign; 0 has none
  bool significance = false;                         ///< both p below kSignificance, or neither

  bool means() const { return spraycan_mean && mimicry_mean; }
  /// Where the paper found no difference, its sign means nothing.
  bool difference(const PaperFigure& paper) const {
    return significance && (sign || !paper.significant);
  }
};

/// `ours` compares spraycan (a) with mimicry (b). Without pairs nothing agrees.
Agreement agreement(const Comparison& ours, const PaperFigure& paper);

}  // namespace mimicry
