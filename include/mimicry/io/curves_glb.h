#pragma once

#include <mimicry/io/curves.h>

namespace mimicry::io {

/// A GLB scene: the target, and each curve as a round tube of its colour (one node a curve, named
/// stroke and technique; parts between gaps are separate tubes). Model units. colors: one per
/// curve, sRGB, 0 to 255. radius > 0, model units.
std::string write_curves_glb(const CurveSet& set, const TriangleMesh& mesh,
                             std::span<const std::array<unsigned char, 3>> colors, double radius);

}  // namespace mimicry::io
