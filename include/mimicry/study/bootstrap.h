#pragma once

#include <cstdint>
#include <functional>
#include <span>

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

}  // namespace mimicry
