#pragma once

namespace mimicry {

/// Windows narrower than this part of their edge are dropped: their neighbours' distances, taken
/// around the corner, differ from theirs by the square of it.
inline constexpr double kLeastWidth = 1e-11;
/// Faces without area, and sources on an edge's line, get this height relative to the edge, of a
/// face its longest: above rounding, and far below what a distance shows.
inline constexpr double kLeastHeight = 1e-13;

}  // namespace mimicry
