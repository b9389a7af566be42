#pragma once

#include <span>
#include <vector>

#include <mimicry/base/types.h>

namespace mimicry {

/// #V: for each position the lowest number with an equal one (bit by bit, -0 taken for 0).
/// Positions that are not finite are equal to none. O(#V).
std::vector<Index> equal_places(std::span<const Vec3> positions);

}  // namespace mimicry
