#include "paint/surface_path.h"

#include <algorithm>

#include "geodesic/site.h"

namespace mimicry {

void SurfacePath::set(const Surface& surface, const SurfacePoint& from,
                      std::span<const Crossing> crossings, const SurfacePoint& to) {
  segments_.clear();
  const TriangleMesh& mesh = surface.mesh();
  SurfacePoint last = from;
  double length = 0.0;
  for (std::size_t i = 0; i <= crossings.size(); ++i) {
    const SurfacePoint next = i < crossings.size() ? surface_point(crossings[i]) : to;
    const Index face = shared_face(mesh, surface.half_edges(), last, next);
    if (face != kNone) {
      const SurfacePoint a = in_face(mesh, last, face), b = in_face(mesh, next, face);
      const double step = (mesh.position(b) - mesh.position(a)).norm();
      if (step > 0.0) segments_.push_back({face, a.bary, b.bary, length, length + step});
      length += step;
    }
    last = next;
  }
}

SurfacePoint SurfacePath::point_at(double s) const {
  auto segment = std::lower_bound(segments_.begin(), segments_.end(), s,
                                  [](const Segment& x, double at) { return x.end < at; });
  if (segment == segments_.end()) --segment;
  const double t = std::clamp((s - segment->begin) / (segment->end - segment->begin), 0.0, 1.0);
  return {segment->face, (1.0 - t) * segment->from + t * segment->to};
}

}  // namespace mimicry
