#include "segment/ends.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <unordered_map>
#include <utility>
#include <vector>

#include <mimicry/curve/edit.h>
#include <mimicry/geodesic/paths.h>

#include "curve/curve_builder.h"
#include "geodesic/site.h"

namespace mimicry {
namespace {

constexpr double kCrossingShare = 0.15;
constexpr double kJoinShare = 0.25;
constexpr double kBoundaryShare = 0.10;

bool is_one_part(const ProjectedCurve& curve) {
  return std::none_of(curve.pieces.begin(), curve.pieces.end(), [](const Piece& p) {
    return p.kind == PieceKind::gap || p.kind == PieceKind::chord;
  });
}

CurvePoint point_on(const Surface& surface, const SurfacePoint& p) {
  CurvePoint point;
  point.surface = p;
  point.position = surface.position(p);
  point.normal = surface.normal(p);
  return point;
}

struct HeadCrossing {
  std::size_t head = 0, tail = 0;  // segments, by the node that begins them
  SurfacePoint point;
};

// Where segments (a, b) and (c, d) of a face meet, as a share of the first.
std::optional<double> meeting(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const auto cross = [](const Vec3& u, const Vec3& v) { return u[1] * v[2] - u[2] * v[1]; };
  const Vec3 u = b - a, v = d - c;
  const double turn = cross(u, v);
  if (std::abs(turn) < 1e-14) return std::nullopt;
  const double s = cross(c - a, v) / turn, t = cross(c - a, u) / turn;
  constexpr double kRounding = 1e-9;
  const auto within = [](double x) { return x >= -kRounding && x <= 1.0 + kRounding; };
  if (!within(s) || !within(t)) return std::nullopt;
  return std::clamp(s, 0.0, 1.0);
}

// Where the head crosses the tail, so that the most of the curve is left between.
std::optional<HeadCrossing> head_crossing(const RefinedCurve& curve, const TriangleMesh& mesh) {
  const double whole = curve.nodes.back().length;
  std::unordered_map<Index, std::vector<std::size_t>> head;
  std::size_t end = 0;
  for (; end + 1 < curve.nodes.size() && curve.nodes[end].length <= kCrossingShare * whole; ++end)
    head[curve.faces[end]].push_back(end);
  std::optional<HeadCrossing> best;
  double most = 0.0;
  for (std::size_t i = curve.nodes.size() - 1; i-- > end;) {
    if (curve.nodes[i + 1].length < (1.0 - kCrossingShare) * whole) break;
    const auto found = head.find(curve.faces[i]);
    if (found == head.end()) continue;
    const Index f = found->first;
    const auto bary = [&](std::size_t n) { return in_face(mesh, curve.nodes[n].point, f).bary; };
    for (const std::size_t k : found->second) {
      const auto s = meeting(bary(k), bary(k + 1), bary(i), bary(i + 1));
      const double left = curve.nodes[i].length - curve.nodes[k].length;
      if (!s || left <= most) continue;
      most = left;
      best = {k, i, normalised({f, (1.0 - *s) * bary(k) + *s * bary(k + 1)})};
    }
  }
  return best;
}

ProjectedCurve trimmed(const RefinedCurve& curve, const HeadCrossing& at_crossing,
                       const Surface& surface) {
  ProjectedCurve loop;
  loop.points.push_back(point_on(surface, at_crossing.point));
  for (std::size_t n = at_crossing.head + 1; n <= at_crossing.tail; ++n)
    loop.points.push_back(point_on(surface, curve.nodes[n].point));
  loop.points.push_back(loop.points.front());
  for (std::size_t i = 0; i + 1 < loop.points.size(); ++i)
    loop.pieces.push_back({PieceKind::same_face,
                           (loop.points[i + 1].position - loop.points[i].position).norm(), 0, 0});
  loop.closed = true;
  return loop;
}

// The place on a boundary nearest in space to a point, within a distance.
std::optional<SurfacePoint> boundary_near(const Surface& surface, const Vec3& x, double radius) {
  const HalfEdges& edges = surface.half_edges();
  const TriangleMesh& mesh = surface.mesh();
  std::optional<SurfacePoint> best;
  for (Index h = 0; h < edges.count(); ++h) {
    if (edges.twin(h) != kNone || repeats_corner(mesh.face(HalfEdges::face(h)))) continue;
    const Vec3& a = mesh.position(edges.tail(h));
    const Vec3 along = mesh.position(edges.head(h)) - a;
    const double size = along.squaredNorm();
    const double t = size > 0.0 ? std::clamp((x - a).dot(along) / size, 0.0, 1.0) : 0.0;
    const double distance = (a + t * along - x).norm();
    if (distance >= radius) continue;
    radius = distance;
    best = surface_point(Crossing{h, t});
  }
  return best;
}

bool lies_on_boundary(const Surface& surface, const SurfacePoint& p) {
  const Site site = site_of(surface.mesh(), p);
  if (site.kind == Site::Kind::vertex) return surface.half_edges().is_boundary_vertex(site.index);
  return site.kind == Site::Kind::edge && !surface.half_edges().has_twin(site.index);
}

// From the curve's end to a boundary nearby: 1 where it is led there, 0 where there is none, and
// -1 where it lies on one already.
int lead_to_boundary(ProjectedCurve& curve, const Surface& surface, double radius) {
  const CurvePoint& end = curve.points.back();
  if (lies_on_boundary(surface, end.surface)) return -1;
  const auto goal = boundary_near(surface, end.position, radius);
  if (!goal) return 0;
  const auto begin = static_cast<std::uint32_t>(curve.crossings.size());
  const LocalPath path = LocalPathFinder(surface).find(end.surface, *goal, curve.crossings);
  if (path.label == PathLabel::disconnected || path.length > radius) {
    curve.crossings.resize(begin);
    return 0;
  }
  curve.pieces.push_back({kind_of(path.label), path.length, begin,
                          static_cast<std::uint32_t>(curve.crossings.size()) - begin});
  CurvePoint point = point_on(surface, *goal);
  point.frame = end.frame;
  point.time_s = end.time_s;
  curve.points.push_back(point);
  return 1;
}

// The same way, the other way round.
ProjectedCurve turned(const ProjectedCurve& curve) {
  ProjectedCurve back;
  back.closed = curve.closed;
  back.points.assign(curve.points.rbegin(), curve.points.rend());
  for (std::size_t i = curve.pieces.size(); i-- > 0;) {
    Piece piece = curve.pieces[i];
    const auto crossings = curve.piece_crossings(i);
    piece.first_crossing = static_cast<std::uint32_t>(back.crossings.size());
    back.crossings.insert(back.crossings.end(), crossings.rbegin(), crossings.rend());
    back.pieces.push_back(piece);
  }
  return back;
}

std::string length_text(double part, double whole) {
  char text[64];
  std::snprintf(text, sizeof text, "%.4g (%.2g %% of its length)", part, 100.0 * part / whole);
  return text;
}

}  // namespace

EndedCurve with_ends(const ProjectedCurve& curve, const Surface& surface, CloseCurves close) {
  if (close == CloseCurves::never || curve.closed) return {curve, ""};
  if (!is_one_part(curve)) return {curve, "has gaps, and is cut as drawn"};
  const double whole = length(curve);
  if (!(whole > 0.0)) return {curve, ""};
  const RefinedCurve refined = refine(curve, surface);
  if (const auto found = head_crossing(refined, surface.mesh())) {
    const double cut_off =
        whole - (refined.nodes[found->tail].length - refined.nodes[found->head + 1].length);
    return {trimmed(refined, *found, surface),
            "closed where its ends cross, " + length_text(cut_off, whole) + " trimmed off"};
  }
  // No way on the surface is shorter than the straight one: far ends need no search.
  const double apart = (curve.points.front().position - curve.points.back().position).norm();
  if (close == CloseCurves::always || apart <= kJoinShare * whole) {
    ProjectedCurve joined = curve;
    const Closing closing = mimicry::close(joined, surface);
    const bool has_gap = joined.points.size() > curve.points.size();
    const double gap = has_gap ? joined.pieces.back().length : 0.0;
    if (closing.closed && (close == CloseCurves::always || gap <= kJoinShare * whole))
      return {joined, gap > 0.0 ? "closed by a geodesic of " + length_text(gap, whole)
                                : "closed where its ends meet"};
  }
  if (close == CloseCurves::always)
    return {curve, "stays open: the surface does not join its ends"};
  ProjectedCurve led = curve;
  const int last = lead_to_boundary(led, surface, kBoundaryShare * whole);
  led = turned(led);
  const int first = lead_to_boundary(led, surface, kBoundaryShare * whole);
  led = turned(led);
  if (last == 1 || first == 1)
    return {led, std::string(last == 1 && first == 1 ? "both ends were"
                             : first == 1            ? "its beginning was"
                                                     : "its end was") +
                     " led to the boundary by " + length_text(length(led) - whole, whole)};
  return {curve,
          last == -1 && first == -1 ? "" : "is open, and a slit where nothing else closes it"};
}

}  // namespace mimicry
