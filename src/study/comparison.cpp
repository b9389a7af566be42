#include <cmath>
#include <cstddef>
#include <limits>

#include <mimicry/study/comparison.h>
#include <mimicry/study/holm.h>

namespace mimicry::study {
namespace {

constexpr double kUndefined = std::numeric_limits<double>::quiet_NaN();

Moments moments(std::span<const double> values) {
  return {mean(values), standard_deviation(values), median(values)};
}

Comparison compare_one(const PairedMeasure& measure, const ComparisonOptions& options) {
  std::vector<double> a, b, differences;
  for (std::size_t i = 0; i < measure.a.size() && i < measure.b.size(); ++i) {
    if (!std::isfinite(measure.a[i]) || !std::isfinite(measure.b[i])) continue;
    a.push_back(measure.a[i]);
    b.push_back(measure.b[i]);
    differences.push_back(measure.a[i] - measure.b[i]);
  }
  Comparison result;
  result.name = measure.name;
  result.pairs = static_cast<int>(a.size());
  result.a = moments(a);
  result.b = moments(b);
  result.test = wilcoxon_signed_rank(a, b, options.test);
  result.difference = a.empty() ? Interval{kUndefined, kUndefined}
                                : bootstrap_interval(differences, mean, options.bootstrap);
  return result;
}

}  // namespace

std::vector<Comparison> compare(std::span<const PairedMeasure> measures,
                                const ComparisonOptions& options) {
  std::vector<Comparison> result;
  std::vector<double> p;
  for (const PairedMeasure& measure : measures) {
    result.push_back(compare_one(measure, options));
    p.push_back(result.back().pairs > 0 ? result.back().test.p() : kUndefined);
  }
  const std::vector<double> adjusted = holm_adjusted(p);
  for (std::size_t i = 0; i < result.size(); ++i) result[i].p_holm = adjusted[i];
  return result;
}

}  // namespace mimicry::study
