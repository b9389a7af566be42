#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <string>

#include <mimicry/base/error.h>
#include <mimicry/study/comparison.h>

#include "study/holm.h"

namespace mimicry {
namespace {

constexpr double kUndefined = std::numeric_limits<double>::quiet_NaN();

Moments moments(std::span<const double> values) {
  return {mean(values), standard_deviation(values), median(values)};
}

// Each participant's mean on both sides, and the test of these.
void compare_participants(std::span<const std::size_t> participants, std::span<const double> a,
                          std::span<const double> b, const WilcoxonOptions& options,
                          Comparison& result) {
  struct Sums {
    double a = 0, b = 0, pairs = 0;
  };
  std::map<std::size_t, Sums> sums;
  for (std::size_t i = 0; i < participants.size(); ++i) {
    Sums& s = sums[participants[i]];
    s.a += a[i];
    s.b += b[i];
    ++s.pairs;
  }
  std::vector<double> mean_a, mean_b;
  for (const auto& [participant, s] : sums) {
    mean_a.push_back(s.a / s.pairs);
    mean_b.push_back(s.b / s.pairs);
  }
  result.participants = static_cast<int>(sums.size());
  result.by_participant = wilcoxon_signed_rank(mean_a, mean_b, options);
}

Comparison compare_one(const PairedMeasure& measure, const ComparisonOptions& options) {
  if (!measure.participants.empty() && measure.participants.size() != measure.a.size())
    throw Error(ErrorKind::invalid_input,
                "comparison of " + measure.name + ": " +
                    std::to_string(measure.participants.size()) + " participants for " +
                    std::to_string(measure.a.size()) + " pairs; give one for each, or none");
  std::vector<double> a, b, differences;
  std::vector<std::size_t> participants;
  for (std::size_t i = 0; i < measure.a.size() && i < measure.b.size(); ++i) {
    if (!std::isfinite(measure.a[i]) || !std::isfinite(measure.b[i])) continue;
    a.push_back(measure.a[i]);
    b.push_back(measure.b[i]);
    differences.push_back(measure.a[i] - measure.b[i]);
    if (!measure.participants.empty()) participants.push_back(measure.participants[i]);
  }
  Comparison result;
  result.name = measure.name;
  result.pairs = static_cast<int>(a.size());
  result.a = moments(a);
  result.b = moments(b);
  result.test = wilcoxon_signed_rank(a, b, options.test);
  result.difference = a.empty() ? Interval{kUndefined, kUndefined}
                                : bootstrap_interval(differences, mean, options.bootstrap);
  compare_participants(participants, a, b, options.test, result);
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

}  // namespace mimicry
