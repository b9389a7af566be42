#pragma once

#include <optional>
#include <span>

namespace mimicry {

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

}  // namespace mimicry
