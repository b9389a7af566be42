#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <mimicry/base/error.h>
#include <mimicry/curve/edit.h>
#include <mimicry/mesh/surface.h>

#include "curve/curve_builder.h"
#include "geodesic/along.h"

namespace mimicry {
namespace {

constexpr std::size_t kReportEvery = 16;  // points: some milliseconds where paths are long

bool on_surface(const Piece& piece) {
  return piece.kind != PieceKind::gap && piece.kind != PieceKind::chord;
}

bool same_point(const CurvePoint& a, const CurvePoint& b) {
  return a.surface.face == b.surface.face && a.surface.bary == b.surface.bary;
}

// The points from p to q as positions.
void polyline_to(const TriangleMesh& mesh, const CurvePoint& p,
                 const std::vector<Crossing>& crossings, const CurvePoint& q,
                 std::vector<Vec3>& polyline) {
  polyline.clear();
  polyline.push_back(p.position);
  for (const Crossing& c : crossings) polyline.push_back(position(mesh, c));
  polyline.push_back(q.position);
}

double squared_distance(const Vec3& x, const std::vector<Vec3>& polyline) {
  double nearest = kInfinity;
  for (std::size_t i = 0; i + 1 < polyline.size(); ++i) {
    const Vec3 along = polyline[i + 1] - polyline[i];
    const double size = along.squaredNorm();
    const double t = size > 0.0 ? std::clamp(along.dot(x - polyline[i]) / size, 0.0, 1.0) : 0.0;
    nearest = std::min(nearest, (x - polyline[i] - t * along).squaredNorm());
  }
  return nearest;
}

}  // namespace

Closing close(ProjectedCurve& curve, const Surface& surface) {
  if (curve.closed) return {true, PathLabel::same_face};
  if (curve.points.size() < 2) return {};
  const CurvePoint& first = curve.points.front();
  const CurvePoint& last = curve.points.back();
  if (same_point(first, last)) {
    curve.closed = true;
    return {true, PathLabel::same_face};
  }
  const auto begin = static_cast<std::uint32_t>(curve.crossings.size());
  const LocalPath path =
      LocalPathFinder(surface).find(last.surface, first.surface, curve.crossings);
  if (path.label == PathLabel::disconnected) return {};
  curve.pieces.push_back({kind_of(path.label), path.length, begin,
                          static_cast<std::uint32_t>(curve.crossings.size()) - begin});
  CurvePoint joint = first;
  joint.frame = last.frame;
  joint.time_s = last.time_s;
  curve.points.push_back(joint);
  curve.closed = true;
  return {true, path.label};
}

ProjectedCurve smooth(const ProjectedCurve& curve, const Surface& surface,
                      const SmoothOptions& options, const ProgressCallback& progress) {
  const TriangleMesh& mesh = surface.mesh();
  const HalfEdges& half_edges = surface.half_edges();
  const std::span<const Vec3> vertex_normals = surface.vertex_normals();
  if (!(options.strength >= 0.0 && options.strength <= 1.0))
    throw Error(ErrorKind::invalid_input,
                "smoothing: strength " + std::to_string(options.strength) + " is not in 0 to 1");
  if (options.iterations < 0 || options.iterations > SmoothOptions::kMostIterations)
    throw Error(ErrorKind::invalid_input,
                "smoothing: " + std::to_string(options.iterations) + " iterations; 0 to " +
                    std::to_string(SmoothOptions::kMostIterations) + " are possible");
  if (options.strength == 0.0) return curve;

  LocalPathFinder paths(surface);
  std::vector<Crossing> crossings;
  const auto between = [&](const SurfacePoint& a, const SurfacePoint& b,
                           double t) -> std::pair<bool, SurfacePoint> {
    crossings.clear();
    if (paths.find(a, b, crossings).label == PathLabel::disconnected) return {false, a};
    return {true, point_along(mesh, half_edges, a, crossings, b, t)};
  };

  const std::size_t count = curve.points.size();
  ProjectedCurve smoothed = curve;
  CurveBuilder builder(surface);
  std::vector<CurvePoint> moved;
  for (int iteration = 0; iteration < options.iterations; ++iteration) {
    moved = smoothed.points;
    for (std::size_t i = 0; i + 1 < count; ++i) {
      if (i % kReportEvery == 0)
        report(progress, "smooth", (iteration + double(i) / double(count)) / options.iterations);
      const bool joint = i == 0 && smoothed.closed;
      if (i == 0 && !joint) continue;
      const std::size_t before = joint ? count - 2 : i - 1;
      const Piece& in = smoothed.pieces[before];
      const Piece& out = smoothed.pieces[i];
      const double both = in.length + out.length;
      if (!on_surface(in) || !on_surface(out) || !(both > 0.0)) continue;
      const auto [found, goal] = between(smoothed.points[before].surface,
                                         smoothed.points[i + 1].surface, in.length / both);
      if (!found) continue;
      CurvePoint& point = moved[i];
      point.surface = between(point.surface, goal, 0.5 * options.strength).second;
      point.position = mesh.position(point.surface);
      point.normal = interpolated_normal(mesh, vertex_normals, point.surface);
    }
    if (smoothed.closed) {
      moved.back().surface = moved.front().surface;
      moved.back().position = moved.front().position;
      moved.back().normal = moved.front().normal;
    }
    builder.clear();
    for (std::size_t i = 0; i < count; ++i) {
      if (i > 0 && smoothed.pieces[i - 1].kind == PieceKind::gap) builder.break_here();
      builder.append(moved[i]);
    }
    const bool closed = smoothed.closed;
    smoothed = builder.curve();
    smoothed.closed = closed;
  }
  return smoothed;
}

ProjectedCurve simplify(const ProjectedCurve& curve, const Surface& surface, double tolerance,
                        const ProgressCallback& progress) {
  const TriangleMesh& mesh = surface.mesh();
  if (!(tolerance >= 0.0 && tolerance < kInfinity))
    throw Error(ErrorKind::invalid_input, "simplifying: tolerance " + std::to_string(tolerance) +
                                              " is not a length of 0 or more");
  const std::size_t count = curve.points.size();
  std::vector<bool> kept(count, false);
  std::vector<std::pair<std::size_t, std::size_t>> runs;  // between points that are kept
  for (std::size_t begin = 0; begin < count;) {
    std::size_t end = begin;
    while (end + 1 < count && on_surface(curve.pieces[end])) ++end;
    kept[begin] = kept[end] = true;
    runs.push_back({begin, end});
    begin = end + 1;
  }
  LocalPathFinder paths(surface);
  std::vector<Crossing> crossings;
  std::vector<Vec3> polyline;
  while (!runs.empty()) {
    const auto [begin, end] = runs.back();
    runs.pop_back();
    if (end - begin < 2) continue;
    report(progress, "simplify", double(begin) / double(count));
    crossings.clear();
    paths.find(curve.points[begin].surface, curve.points[end].surface, crossings);
    polyline_to(mesh, curve.points[begin], crossings, curve.points[end], polyline);
    std::size_t farthest = begin;
    double most = tolerance * tolerance;
    for (std::size_t i = begin + 1; i < end; ++i) {
      if (i % kReportEvery == 0) report(progress, "simplify", double(begin) / double(count));
      const double distance = squared_distance(curve.points[i].position, polyline);
      if (distance > most) farthest = i, most = distance;
    }
    if (farthest == begin) continue;
    kept[farthest] = true;
    runs.push_back({begin, farthest});
    runs.push_back({farthest, end});
  }
  // The builder finds the same paths again.
  CurveBuilder builder(surface);
  for (std::size_t i = 0; i < count; ++i) {
    if (!kept[i]) continue;
    if (i > 0 && curve.pieces[i - 1].kind == PieceKind::gap) builder.break_here();
    builder.append(curve.points[i]);
  }
  ProjectedCurve simplified = builder.curve();
  simplified.closed = curve.closed;
  return simplified;
}

}  // namespace mimicry
