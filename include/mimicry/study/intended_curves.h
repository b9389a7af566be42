#pragma once

#include <string_view>
#include <vector>

#include <mimicry/spatial/target.h>
#include <mimicry/stroke/stroke.h>

namespace mimicry {

/// Three or more curves that a person might mean to draw on a built-in shape: "closed", "winding",
/// and "across" (over sharp edges; on smooth shapes through the region of highest curvature). They
/// are laid out in the shape's own parameters and mapped to the closest points of `target`, the
/// shape at any resolution (noisy-cube, with any noise: the curves of the plain cube, moved with
/// its faces). Points about 0.5 % of the diagonal apart, in the order of drawing; a closed curve
/// ends in its first point. Throws Error(invalid_input) for an unknown shape, and for "noisy-cube"
/// where the target has not the faces of one. About 5 ms a curve.
std::vector<Intention> intended_curves(std::string_view shape, const Target& target);

}  // namespace mimicry
