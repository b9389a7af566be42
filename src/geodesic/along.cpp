#include "geodesic/along.h"

#include "geodesic/site.h"

namespace mimicry {

SurfacePoint point_along(const TriangleMesh& mesh, const HalfEdges& half_edges,
                         const SurfacePoint& from, std::span<const Crossing> crossings,
                         const SurfacePoint& to, double t) {
  if (!(t > 0.0)) return from;
  if (t >= 1.0) return to;
  const auto point = [&](std::size_t i) {
    return i == 0 ? from : i > crossings.size() ? to : surface_point(crossings[i - 1]);
  };
  const std::size_t segments = crossings.size() + 1;
  double length = 0.0;
  for (std::size_t i = 0; i < segments; ++i)
    length += (mesh.position(point(i + 1)) - mesh.position(point(i))).norm();
  double left = t * length;
  for (std::size_t i = 0; i < segments; ++i) {
    const SurfacePoint a = point(i);
    const SurfacePoint b = point(i + 1);
    const double step = (mesh.position(b) - mesh.position(a)).norm();
    if (left >= step) {
      left -= step;
      continue;
    }
    const Index face = shared_face(mesh, half_edges, a, b);
    if (face == kNone) return a;
    const double part = left / step;
    return {face, (1.0 - part) * in_face(mesh, a, face).bary + part * in_face(mesh, b, face).bary};
  }
  return to;
}

}  // namespace mimicry
