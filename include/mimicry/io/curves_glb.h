#pragma once

#include <array>
#include <span>

#include <mimicry/io/curves.h>

namespace mimicry {

/// A GLB scene: the target, and each curve as a round tube of its colour (one node a curve, named
/// stroke and technique; parts between gaps are separate tubes). Model units. The target has
/// normals: its faces stay, and its vertices are split where faces meet at more than 38 degrees.
/// colors: one per curve, sRGB, 0 to 255. radius: > 0, model units; of curves without radii of
/// their own.
std::string write_curves_glb(const CurveSet& set, const TriangleMesh& mesh,
                             std::span<const std::array<unsigned char, 3>> colors, double radius);

/// The same with line strips (primitives of mode 3) in place of tubes: the curves' own points,
/// which viewers show one pixel wide. Parts of a single point are left out.
std::string write_curves_glb_lines(const CurveSet& set, const TriangleMesh& mesh,
                                   std::span<const std::array<unsigned char, 3>> colors);

}  // namespace mimicry
