#include "technique/planar_section.h"

#include <algorithm>

#include <mimicry/mesh/half_edges.h>

namespace mimicry {

SurfacePoint drawn_inward(const SurfacePoint& q) {
  constexpr double kInward = 1e-9;
  SurfacePoint inside{q.face, q.bary.cwiseMax(kInward)};
  inside.bary /= inside.bary.sum();
  return inside;
}

SurfacePoint closest_on_section(const Surface& surface, const SurfacePoint& q, const Vec3& normal,
                                const Vec3& r) {
  const TriangleMesh& mesh = surface.mesh();
  const HalfEdges& half_edges = surface.half_edges();
  const SurfacePoint start = drawn_inward(q);
  const Vec3 origin = mesh.position(start);
  const auto side = [&](Index v) { return normal.dot(mesh.position(v) - origin); };
  // The section leaves every face through the half-edge that runs from the plane's negative side to
  // the other one, which vertices on the plane belong to, and enters it through the one that runs
  // back.
  const auto crossing = [&](Index face, bool leaves) {
    for (Index h = 3 * face; h < 3 * face + 3; ++h) {
      const double a = side(half_edges.tail(h)), b = side(half_edges.head(h));
      if ((a < 0.0) == leaves && (b < 0.0) != leaves)
        return Crossing{h, std::clamp(a / (a - b), 0.0, 1.0)};
    }
    return Crossing{};
  };

  SurfacePoint best = q;
  double best2 = (mesh.position(q) - r).squaredNorm();
  const auto consider = [&](const Crossing& entry, const Crossing& exit) {
    const SurfacePoint a = surface_point(entry), b = surface_point(exit);
    const Vec3 from = mesh.position(a), way = mesh.position(b) - from;
    const double length2 = way.squaredNorm();
    const double t = length2 > 0.0 ? std::clamp((r - from).dot(way) / length2, 0.0, 1.0) : 0.0;
    const double d2 = (from + t * way - r).squaredNorm();
    if (d2 >= best2) return;
    best2 = d2;
    best = {a.face, (1.0 - t) * a.bary + t * b.bary};
  };
  // Forward to the start or a boundary; then, from a boundary, backward too.
  for (const bool forward : {true, false}) {
    Index face = q.face;
    for (Index step = 0; step < half_edges.count(); ++step) {
      const Crossing exit = crossing(face, true), entry = crossing(face, false);
      if (exit.half_edge == kNone || entry.half_edge == kNone) break;  // rounding at a vertex
      consider(entry, exit);
      const Index twin = half_edges.twin(forward ? exit.half_edge : entry.half_edge);
      if (twin < 0) break;
      face = HalfEdges::face(twin);
      if (face == q.face) return best;
    }
  }
  return best;
}

}  // namespace mimicry
