#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include <mimicry/base/error.h>
#include <mimicry/base/random.h>
#include <mimicry/study/comparison.h>

#include "study/normal_distribution.h"

namespace mimicry {
namespace {

double quantile(const std::vector<double>& sorted, double p) {
  const double at = std::clamp(p, 0.0, 1.0) * static_cast<double>(sorted.size() - 1);
  const auto low = static_cast<std::size_t>(at);
  if (low + 1 >= sorted.size()) return sorted.back();
  return sorted[low] + (at - static_cast<double>(low)) * (sorted[low + 1] - sorted[low]);
}

// Skewness of the statistic's jackknife values over 6.
double acceleration(std::span<const double> values, const Statistic& statistic) {
  if (values.size() < 2) return 0;
  std::vector<double> left(values.begin() + 1, values.end()), jackknife;
  for (std::size_t i = 0; i < values.size(); ++i) {
    jackknife.push_back(statistic(left));
    if (i < left.size()) left[i] = values[i];
  }
  const double centre = mean(jackknife);
  double squares = 0, cubes = 0;
  for (const double x : jackknife) {
    const double d = centre - x;
    squares += d * d;
    cubes += d * d * d;
  }
  const double scale = std::pow(squares, 1.5);
  return scale > 0 ? cubes / (6 * scale) : 0;
}

void check(std::span<const double> values, const BootstrapOptions& o) {
  const auto fail = [](const std::string& what) {
    throw Error(ErrorKind::invalid_input, "bootstrap: " + what);
  };
  if (values.empty()) fail("there are no values");
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!std::isfinite(values[i])) fail("value " + std::to_string(i) + " is not finite");
  if (o.resamples < 100 || o.resamples > 1'000'000)
    fail("resamples must be within 100 to 1,000,000");
  if (!std::isfinite(o.level) || o.level <= 0 || o.level >= 1)
    fail("level must be between 0 and 1");
}

}  // namespace

double mean(std::span<const double> values) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  double sum = 0;
  for (const double x : values) sum += x;
  return sum / static_cast<double>(values.size());
}

double standard_deviation(std::span<const double> values) {
  if (values.size() < 2) return std::numeric_limits<double>::quiet_NaN();
  const double centre = mean(values);
  double squares = 0;
  for (const double x : values) squares += (x - centre) * (x - centre);
  return std::sqrt(squares / static_cast<double>(values.size() - 1));
}

double median(std::span<const double> values) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  std::vector<double> sorted(values.begin(), values.end());
  std::sort(sorted.begin(), sorted.end());
  return quantile(sorted, 0.5);
}

Interval bootstrap_interval(std::span<const double> values, const Statistic& statistic,
                            const BootstrapOptions& options) {
  check(values, options);
  Random random(options.seed);
  const auto count = static_cast<std::uint32_t>(values.size());
  std::vector<double> drawn(values.size()), resampled;
  resampled.reserve(static_cast<std::size_t>(options.resamples));
  for (int k = 0; k < options.resamples; ++k) {
    for (double& x : drawn) x = values[random.below(count)];
    resampled.push_back(statistic(drawn));
  }
  std::sort(resampled.begin(), resampled.end());
  const double tail = 0.5 * (1 - options.level);
  if (options.kind == BootstrapKind::percentile)
    return {quantile(resampled, tail), quantile(resampled, 1 - tail)};

  const double whole = statistic(values);
  const auto below = std::lower_bound(resampled.begin(), resampled.end(), whole);
  const auto above = std::upper_bound(below, resampled.end(), whole);
  const double share =
      (static_cast<double>(below - resampled.begin()) + 0.5 * static_cast<double>(above - below)) /
      static_cast<double>(resampled.size());
  // Rounding may leave the statistic outside of its resamples where these are all but equal.
  const double least = 0.5 / static_cast<double>(resampled.size());
  const double bias = normal_quantile(std::clamp(share, least, 1 - least));
  const double a = acceleration(values, statistic);
  const auto adjusted = [&](double p) {
    const double z = bias + normal_quantile(p);
    const double room = 1 - a * z;
    return room > 0 ? normal_cdf(bias + z / room) : (z > 0 ? 1.0 : 0.0);
  };
  return {quantile(resampled, adjusted(tail)), quantile(resampled, adjusted(1 - tail))};
}

}  // namespace mimicry
