#include <algorithm>
#include <cassert>

#include <mimicry/curve/projected_curve.h>

#include "geodesic/site.h"

namespace mimicry {

SurfacePoint point_at_length(const RefinedCurve& curve, const TriangleMesh& mesh, double s) {
  assert(!curve.nodes.empty());
  const auto& nodes = curve.nodes;
  if (!(s > 0.0)) return nodes.front().point;
  if (s >= nodes.back().length) return nodes.back().point;
  // The first node at s or beyond: there is one before it, which lies before s and in its part.
  const auto after =
      std::lower_bound(nodes.begin(), nodes.end(), s,
                       [](const RefinedNode& node, double length) { return node.length < length; });
  const auto i = static_cast<std::size_t>(after - nodes.begin()) - 1;
  const Index face = curve.faces[i];
  const SurfacePoint from = in_face(mesh, nodes[i].point, face);
  const SurfacePoint to = in_face(mesh, nodes[i + 1].point, face);
  const double t = (s - nodes[i].length) / (nodes[i + 1].length - nodes[i].length);
  return {face, (1.0 - t) * from.bary + t * to.bary};
}

SurfacePoint point_at_length(const ProjectedCurve& curve, const Surface& surface, double s) {
  const TriangleMesh& mesh = surface.mesh();
  return point_at_length(refine(curve, surface), mesh, s);
}

std::vector<SurfacePoint> resample(const ProjectedCurve& curve, const Surface& surface,
                                   std::size_t count) {
  const TriangleMesh& mesh = surface.mesh();
  std::vector<SurfacePoint> points;
  if (curve.points.empty() || count == 0) return points;
  const RefinedCurve refined = refine(curve, surface);
  const double length = refined.nodes.back().length;
  points.reserve(count);
  points.push_back(curve.points.front().surface);
  for (std::size_t i = 1; i + 1 < count; ++i)
    points.push_back(point_at_length(
        refined, mesh, length * (static_cast<double>(i) / static_cast<double>(count - 1))));
  if (count > 1) points.push_back(curve.points.back().surface);
  return points;
}

}  // namespace mimicry
