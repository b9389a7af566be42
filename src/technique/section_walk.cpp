#include "technique/section_walk.h"

#include <algorithm>

#include <mimicry/mesh/half_edges.h>

#include "technique/planar_section.h"

namespace mimicry {
namespace {

constexpr int kMostSteps = 4096;

// The same point, in the barycentrics of the face on the other side of the half-edge.
SurfacePoint across(Index twin, double t) {
  return surface_point(Crossing{twin, 1.0 - t});
}

}  // namespace

SurfacePoint walk_section(const Surface& surface, const SurfacePoint& q, const Vec3& motion,
                          const Vec3& normal, double length) {
  const TriangleMesh& mesh = surface.mesh();
  const HalfEdges& half_edges = surface.half_edges();
  const Vec3 sideways = normal.cross(motion);
  const double norm = sideways.norm();
  if (!(norm > 0.0) || !(length > 0.0)) return q;
  const Vec3 plane = sideways / norm;

  SurfacePoint at = drawn_inward(q);
  const Vec3 origin = mesh.position(at);
  const auto side = [&](Index v) { return plane.dot(mesh.position(v) - origin); };
  // Forward, a section leaves every face through the half-edge that runs from the plane's negative
  // side to the other one, which vertices on the plane belong to: one in each face that it crosses.
  const auto leaves = [&](Index h) {
    return side(half_edges.tail(h)) < 0.0 && side(half_edges.head(h)) >= 0.0;
  };
  double left = length;
  Index first = 3 * at.face;
  for (int i = 0; i < kMostSteps; ++i) {
    Index h = first;
    for (int k = 0; k < 2 && !leaves(h); ++k) h = HalfEdges::next(h);
    if (!leaves(h)) return at;
    const double a = side(half_edges.tail(h)), b = side(half_edges.head(h));
    const SurfacePoint exit = surface_point(Crossing{h, std::clamp(a / (a - b), 0.0, 1.0)});
    const double step = (mesh.position(exit) - mesh.position(at)).norm();
    if (step >= left) {
      at.bary += (left / step) * (exit.bary - at.bary);
      at.bary = at.bary.cwiseMax(0.0);
      return at;
    }
    left -= step;
    const Index twin = half_edges.twin(h);
    if (twin < 0) return exit;
    at = across(twin, exit.bary[(HalfEdges::corner(h) + 1) % 3]);
    first = twin;
  }
  return at;
}

}  // namespace mimicry
