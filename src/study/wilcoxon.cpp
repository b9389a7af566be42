#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include <mimicry/base/error.h>
#include <mimicry/study/comparison.h>

#include "study/normal_distribution.h"

namespace mimicry {
namespace {

struct Difference {
  double size;
  int sign;
};

std::vector<Difference> differences(std::span<const double> a, std::span<const double> b) {
  if (a.size() != b.size())
    throw Error(ErrorKind::invalid_input, "signed-rank test: " + std::to_string(a.size()) +
                                              " numbers cannot be paired with " +
                                              std::to_string(b.size()));
  std::vector<Difference> result;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (!std::isfinite(a[i]) || !std::isfinite(b[i]))
      throw Error(ErrorKind::invalid_input, "signed-rank test: pair " + std::to_string(i) +
                                                " has a number that is not finite; leave it out");
    const double d = a[i] - b[i];
    result.push_back({std::abs(d), d > 0 ? 1 : d < 0 ? -1 : 0});
  }
  return result;
}

// Two-sided p of the rank sum w of ranks 1 .. n by counting the sets with each sum; the counts are
// divided by two for each rank and so are probabilities.
double exact_p(int n, double w) {
  const int most = n * (n + 1) / 2;
  std::vector<double> chance(static_cast<std::size_t>(most) + 1, 0.0);
  chance[0] = 1;
  int reach = 0;
  for (int rank = 1; rank <= n; ++rank) {
    reach += rank;
    for (int s = reach; s >= 0; --s) {
      const double without = chance[static_cast<std::size_t>(s)];
      const double with = s >= rank ? chance[static_cast<std::size_t>(s - rank)] : 0.0;
      chance[static_cast<std::size_t>(s)] = 0.5 * (without + with);
    }
  }
  // The distribution is symmetric: the smaller tail is the one at or below the smaller sum.
  const int low = static_cast<int>(std::lround(std::min(w, most - w)));
  double tail = 0;
  for (int s = 0; s <= low; ++s) tail += chance[static_cast<std::size_t>(s)];
  return std::min(1.0, 2 * tail);
}

}  // namespace

WilcoxonResult wilcoxon_signed_rank(std::span<const double> a, std::span<const double> b,
                                    const WilcoxonOptions& options) {
  if (options.most_exact > 1000)
    throw Error(ErrorKind::invalid_input, "signed-rank test: most_exact is above 1000");
  std::vector<Difference> d = differences(a, b);
  WilcoxonResult result;
  result.pairs = static_cast<int>(d.size());
  std::sort(d.begin(), d.end(),
            [](const Difference& x, const Difference& y) { return x.size < y.size; });
  const auto first_nonzero =
      std::find_if(d.begin(), d.end(), [](const Difference& x) { return x.sign != 0; });
  const bool has_zeros = first_nonzero != d.begin();
  result.differences = static_cast<int>(d.end() - first_nonzero);
  if (options.zeros == ZeroDifferences::dropped) d.erase(d.begin(), first_nonzero);

  double squares = 0;
  for (std::size_t i = 0; i < d.size();) {
    std::size_t end = i + 1;
    while (end < d.size() && d[end].size == d[i].size) ++end;
    const double rank = 0.5 * static_cast<double>(i + end + 1);
    for (; i < end; ++i) {
      if (d[i].sign == 0) continue;
      result.ties = result.ties || rank != static_cast<double>(i + 1);
      (d[i].sign > 0 ? result.w_plus : result.w_minus) += rank;
      squares += rank * rank;
    }
  }
  if (result.differences == 0) return result;

  const double total = result.w_plus + result.w_minus;
  double off = result.w_plus - 0.5 * total;
  if (options.continuity_correction)
    off = off > 0 ? std::max(0.0, off - 0.5) : std::min(0.0, off + 0.5);
  result.z = off / std::sqrt(0.25 * squares);
  result.p_normal = std::min(1.0, 2 * normal_cdf(-std::abs(result.z)));
  const bool ranked_zeros = has_zeros && options.zeros == ZeroDifferences::ranked;
  if (result.differences <= options.most_exact && !result.ties && !ranked_zeros)
    result.p_exact = exact_p(result.differences, result.w_plus);
  result.effect_r = result.z / std::sqrt(static_cast<double>(result.differences));
  result.rank_biserial = (result.w_plus - result.w_minus) / total;
  return result;
}

}  // namespace mimicry
