#include <string>

#include <mimicry/base/error.h>
#include <mimicry/geodesic/paths.h>

#include "geodesic/along.h"
#include "geodesic/site.h"

namespace mimicry {

BezierCurve bezier(const Surface& surface, std::span<const SurfacePoint> controls,
                   std::size_t count, const LocalPathOptions& options) {
  const TriangleMesh& mesh = surface.mesh();
  const HalfEdges& half_edges = surface.half_edges();
  if (controls.empty())
    throw Error(ErrorKind::invalid_input, "Bezier curve: no control points; give one or more");
  if (count < 2)
    throw Error(ErrorKind::invalid_input,
                "Bezier curve: " + std::to_string(count) + " points asked for; ask for 2 or more");
  for (std::size_t i = 0; i < controls.size(); ++i)
    check_surface_point(mesh, controls[i], "control point " + std::to_string(i));

  BezierCurve curve;
  LocalPathFinder paths(surface);
  const auto find = [&](const SurfacePoint& a, const SurfacePoint& b,
                        std::vector<Crossing>& crossings) {
    const PathLabel label = paths.find(a, b, crossings, options).label;
    curve.connected = curve.connected && label != PathLabel::disconnected;
    curve.all_shortest = curve.all_shortest && label != PathLabel::locally_shortest;
  };
  // The control polygon is the same for all parameters.
  std::vector<std::vector<Crossing>> sides(controls.size() - 1);
  for (std::size_t i = 0; i < sides.size(); ++i) find(controls[i], controls[i + 1], sides[i]);
  if (!curve.connected) return curve;

  std::vector<SurfacePoint> level;
  std::vector<Crossing> crossings;
  curve.points.reserve(count);
  curve.points.push_back(controls.front());
  for (std::size_t k = 1; k + 1 < count; ++k) {
    const double t = static_cast<double>(k) / static_cast<double>(count - 1);
    level.assign(controls.begin(), controls.end());
    for (std::size_t n = controls.size() - 1; n > 0; --n)
      for (std::size_t i = 0; i < n; ++i) {
        const bool side = n == sides.size();
        crossings.clear();
        if (!side) find(level[i], level[i + 1], crossings);
        level[i] =
            point_along(mesh, half_edges, level[i], side ? sides[i] : crossings, level[i + 1], t);
      }
    curve.points.push_back(level.front());
  }
  curve.points.push_back(controls.back());
  return curve;
}

}  // namespace mimicry
