#pragma once

namespace mimicry {

/// P(Z <= z) of the standard normal distribution; full relative precision in both tails.
double normal_cdf(double z);

/// The z with normal_cdf(z) = p, to 1e-14; -infinity for p <= 0 and infinity for p >= 1. p must not
/// be NaN. Acklam's rational approximation (2003) and one step of Halley's method.
double normal_quantile(double p);

}  // namespace mimicry
