#pragma once

#include <cstddef>
#include <span>

namespace mimicry {

/// How much a measure changes when a task is repeated.
struct Consistency {
  double mean_change = 0.0;   ///< mean |f(i) - f(i')| / f(i); NaN where no pair counts
  std::size_t used = 0;       ///< pairs in the mean
  std::size_t dropped = 0;    ///< changes farther than 5 standard deviations from the mean of all
  std::size_t undefined = 0;  ///< pairs with f(i) not above 0, or a number that is not finite
};

/// first: f(i) of the strokes that were repeated; repeat: f(i') of their repeats; as many. The mean
/// and the standard deviation (n - 1) that decide what is dropped are those of all defined changes
/// (paper, section 6: applied to D_ep and F_g).
Consistency consistency(std::span<const double> first, std::span<const double> repeat);

}  // namespace mimicry
