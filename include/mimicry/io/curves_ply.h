#pragma once

#include <array>
#include <span>

#include <mimicry/io/curves.h>

namespace mimicry {

/// Binary PLY with the tubes of all curves, `vertex` (x, y, z, nx, ny, nz, red, green, blue, curve)
/// and `face` (vertex_indices) elements. colors: one per curve, 0 to 255. radius: > 0, model
/// units; of curves without radii of their own. Throws Error(unsupported) where there are more
/// vertices than an Index counts.
std::string write_curves_ply(const CurveSet& set, const TriangleMesh& mesh,
                             std::span<const std::array<unsigned char, 3>> colors, double radius);

/// Ascii PLY with the curves' own points: `vertex` (x, y, z, red, green, blue, curve) and `edge`
/// (vertex1, vertex2) elements. Many readers know no edges (docs/formats.md).
std::string write_curves_ply_lines(const CurveSet& set, const TriangleMesh& mesh,
                                   std::span<const std::array<unsigned char, 3>> colors);

}  // namespace mimicry
