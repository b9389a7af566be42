#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include <mimicry/study/bootstrap.h>
#include <mimicry/study/wilcoxon.h>

namespace mimicry {

/// One measure of the same tasks done two ways: a[i] and b[i] belong together.
struct PairedMeasure {
  std::string name;
  std::vector<double> a, b;
  /// Whose each pair is, as a number of any kind; empty: not known.
  std::vector<std::size_t> participants = {};
};

struct Moments {
  double mean = 0, standard_deviation = 0, median = 0;
};

/// One row of the paper's table.
struct Comparison {
  std::string name;
  int pairs = 0;        ///< with finite numbers on both sides; the others are left out
  Moments a, b;         ///< NaN where there are too few pairs
  WilcoxonResult test;  ///< z > 0 where a is larger
  Interval difference;  ///< confidence interval of the mean of a - b; NaN without pairs
  double p_holm = 1;    ///< over all measures given together
  /// With pairs; 0 where it is not known whose they are.
  int participants = 0;
  /// The same test of the participants' means. Strokes of one person resemble each other: taken
  /// for independent, as in `test`, they make p too small.
  WilcoxonResult by_participant;
};

struct ComparisonOptions {
  WilcoxonOptions test;
  BootstrapOptions bootstrap;
};

/// Compares each measure's pairs (paper, section 6.4: signed-rank tests); Holm's correction is over
/// all of `measures`, where one without pairs does not count. Deterministic. About 0.1 s for 1,000
/// pairs of a measure.
std::vector<Comparison> compare(std::span<const PairedMeasure> measures,
                                const ComparisonOptions& options = {});

}  // namespace mimicry
