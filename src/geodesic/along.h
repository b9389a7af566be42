#pragma once

#include <span>

#include <mimicry/mesh/half_edges.h>
#include <mimicry/mesh/triangle_mesh.h>

namespace mimicry {

/// The point at the part t of a path's length, 0 to 1 (beyond: the ends); `from` and `to` to the
/// bit at 0 and 1. The path is connected, as all path functions of this module give it, and its
/// points are valid. O(crossings).
SurfacePoint point_along(const TriangleMesh& mesh, const HalfEdges& half_edges,
                         const SurfacePoint& from, std::span<const Crossing> crossings,
                         const SurfacePoint& to, double t);

}  // namespace mimicry
