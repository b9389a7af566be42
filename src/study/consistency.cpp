#include <cassert>
#include <cmath>
#include <limits>
#include <vector>

#include <mimicry/study/measures.h>

namespace mimicry {

Consistency consistency(std::span<const double> first, std::span<const double> repeat) {
  assert(first.size() == repeat.size());
  Consistency result;
  std::vector<double> changes;
  double sum = 0.0;
  for (std::size_t i = 0; i < first.size(); ++i) {
    if (!std::isfinite(first[i]) || !std::isfinite(repeat[i]) || !(first[i] > 0.0)) {
      ++result.undefined;
      continue;
    }
    changes.push_back(std::abs(first[i] - repeat[i]) / first[i]);
    sum += changes.back();
  }
  const auto count = static_cast<double>(changes.size());
  double squares = 0.0;
  for (const double change : changes) {
    const double off = change - sum / count;
    squares += off * off;
  }
  const double deviation = changes.size() > 1 ? std::sqrt(squares / (count - 1.0)) : 0.0;
  double kept = 0.0;
  for (const double change : changes) {
    // Rounding must not drop equal changes, whose deviation is about 0.
    if (std::abs(change - sum / count) > 5.0 * deviation + 1e-12) {
      ++result.dropped;
      continue;
    }
    kept += change;
    ++result.used;
  }
  result.mean_change = result.used > 0 ? kept / static_cast<double>(result.used)
                                       : std::numeric_limits<double>::quiet_NaN();
  return result;
}

}  // namespace mimicry
