#pragma once

#include <span>
#include <vector>

namespace mimicry {

/// Holm's (1979) adjusted p of several tests, in the given order: the k-th smallest of m is
/// multiplied by m - k + 1, is never less than a smaller one's, and at most 1. Comparing these with
/// alpha keeps the chance of one or more false findings below alpha. NaN stays NaN and does not
/// count.
std::vector<double> holm_adjusted(std::span<const double> p);

}  // namespace mimicry
