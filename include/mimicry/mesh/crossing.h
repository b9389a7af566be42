#pragma once

#include <mimicry/base/types.h>
#include <mimicry/mesh/half_edges.h>
#include <mimicry/mesh/triangle_mesh.h>

namespace mimicry {

/// Where a path on the surface meets an edge: (1 - t) tail + t head of the half-edge, 0 <= t <= 1.
/// A path that passes through a vertex names a half-edge that leaves it, with t = 0 exactly.
struct Crossing {
  Index half_edge = kNone;
  double t = 0.0;
};

inline Vec3 position(const TriangleMesh& mesh, const Crossing& c) {
  const Index f = HalfEdges::face(c.half_edge);
  const int k = HalfEdges::corner(c.half_edge);
  return (1.0 - c.t) * mesh.corner(f, k) + c.t * mesh.corner(f, (k + 1) % 3);
}

/// The crossing as a point of the half-edge's own face.
inline SurfacePoint surface_point(const Crossing& c) {
  SurfacePoint p{HalfEdges::face(c.half_edge), Vec3::Zero()};
  const int k = HalfEdges::corner(c.half_edge);
  p.bary[k] = 1.0 - c.t;
  p.bary[(k + 1) % 3] = c.t;
  return p;
}

}  // namespace mimicry
