#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <mimicry/study/recording.h>

namespace mimicry {

enum class BootstrapKind {
  percentile,
  bca,  ///< bias-corrected and accelerated (Efron 1987): nearer to the stated level
};

struct BootstrapOptions {
  BootstrapKind kind = BootstrapKind::bca;
  int resamples = 10000;  ///< 100 to 1,000,000
  double level = 0.95;    ///< within (0, 1)
  std::uint64_t seed = 1;
};

struct Interval {
  double low = 0, high = 0;
};

using Statistic = std::function<double(std::span<const double>)>;

/// Confidence interval of a statistic of independent values, by resampling them with replacement.
/// Same arguments, same bits. Quantiles of the resamples are linear between order statistics (R's
/// type 7). BCa: bias from the share of resamples below the statistic (half of the equal ones),
/// acceleration from the jackknife; where all resamples are equal the interval is that value.
/// Throws Error(invalid_input) for no values, for values that are not finite, and for options out
/// of range. For the difference of a paired measure pass the pairs' differences. O(resamples x
/// values).
Interval bootstrap_interval(std::span<const double> values, const Statistic& statistic,
                            const BootstrapOptions& options = {});

/// NaN for no values.
double mean(std::span<const double> values);
/// Of the sample (n - 1); NaN for fewer than two values.
double standard_deviation(std::span<const double> values);
/// The middle value, or the mean of the two; NaN for no values. O(n log n).
double median(std::span<const double> values);

/// What becomes of pairs without a difference.
enum class ZeroDifferences {
  dropped,  ///< before ranking (Wilcoxon 1945; R's wilcox.test, MATLAB's signrank)
  ranked,   ///< ranked with the others, then left out of the sums (Pratt 1959)
};

struct WilcoxonOptions {
  ZeroDifferences zeros = ZeroDifferences::dropped;
  /// Moves the rank sum by a half toward its mean in the normal approximation. R does so unless
  /// told otherwise; the paper's figures are without.
  bool continuity_correction = false;
  /// The exact p is found up to this many differences; at most 1000.
  int most_exact = 50;
};

struct WilcoxonResult {
  int pairs = 0;                  ///< all pairs
  int differences = 0;            ///< N: pairs with a difference
  bool ties = false;              ///< two differences are equally large
  double w_plus = 0;              ///< V: sum of the ranks of the positive differences
  double w_minus = 0;             ///< of the negative ones
  double z = 0;                   ///< > 0 where a is larger than b
  double p_normal = 1;            ///< two-sided, normal approximation with tie correction
  std::optional<double> p_exact;  ///< two-sided; for few differences without ties or ranked zeros
  double effect_r = 0;            ///< z / sqrt(N)
  double rank_biserial = 0;       ///< (w_plus - w_minus) / (w_plus + w_minus)

  double p() const { return p_exact.value_or(p_normal); }
};

/// Paired two-sided signed-rank test of a_i - b_i, numbers of equal count. Differences are ranked
/// by size with mean ranks for ties; under the hypothesis each rank r_i is positive or negative
/// with equal chance, so that w_plus has mean sum r_i / 2 and variance sum r_i^2 / 4, which is the
/// usual tie correction. Exact p: the distribution of w_plus by counting, 2 min(P(V <= w_plus),
/// P(V >= w_plus)). Pairs with a number that is not finite throw Error(invalid_input), as do counts
/// that differ. Without any difference z = 0 and p = 1. O(n log n), exact O(n^3).
WilcoxonResult wilcoxon_signed_rank(std::span<const double> a, std::span<const double> b,
                                    const WilcoxonOptions& options = {});

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
