#include <functional>
#include <queue>
#include <unordered_map>
#include <utility>
#include <vector>

#include "geodesic/site.h"
#include "segment/ends.h"

namespace mimicry {
namespace {

Index nearest_corner(const Surface& surface, const CurvePoint& point) {
  const Face& face = surface.mesh().face(point.surface.face);
  Index best = face[0];
  for (const Index v : face)
    if ((surface.mesh().position(v) - point.position).norm() <
        (surface.mesh().position(best) - point.position).norm())
      best = v;
  return best;
}

// Shortest over edges (Dijkstra 1959), of equal ones over vertices of lower numbers; from's
// successors up to and with `to`. Empty where there is no way.
std::vector<Index> edge_path(const Surface& surface, Index from, Index to) {
  struct Reached {
    double distance = kInfinity;
    Index before = kNone;
    bool done = false;
  };
  const HalfEdges& edges = surface.half_edges();
  std::unordered_map<Index, Reached> reached;
  using Entry = std::pair<double, Index>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  reached[from].distance = 0.0;
  open.emplace(0.0, from);
  const auto relax = [&](Index v, Index w) {
    const double distance =
        reached[v].distance + (surface.mesh().position(v) - surface.mesh().position(w)).norm();
    Reached& other = reached[w];
    if (distance >= other.distance) return;
    other.distance = distance;
    other.before = v;
    open.emplace(distance, w);
  };
  while (!open.empty()) {
    const Index v = open.top().second;
    open.pop();
    if (std::exchange(reached[v].done, true)) continue;
    if (v == to) break;
    const Index first = edges.outgoing(v);
    for (Index h = first; h >= 0;) {
      relax(v, edges.head(h));
      const Index side = HalfEdges::previous(h);
      if (!edges.has_twin(side)) relax(v, edges.tail(side));  // the boundary's last edge
      h = edges.ccw(h);
      if (h == first) break;
    }
  }
  std::vector<Index> path;
  for (Index v = to; v != kNone && v != from; v = reached[v].before) path.push_back(v);
  if (!path.empty() && reached[path.back()].before != from) return {};
  return {path.rbegin(), path.rend()};
}

}  // namespace

ProjectedCurve along_vertices(const ProjectedCurve& curve, const Surface& surface) {
  ProjectedCurve along;
  const auto push = [&](Index v, const CurvePoint& of, PieceKind kind) {
    CurvePoint point = of;
    point.surface = vertex_point(surface.half_edges(), v);
    point.position = surface.mesh().position(v);
    point.normal = surface.vertex_normals()[at(v)];
    if (!along.points.empty()) {
      const double step = (point.position - along.points.back().position).norm();
      along.pieces.push_back({kind, kind == PieceKind::gap ? 0.0 : step, 0, 0});
    }
    along.points.push_back(point);
  };
  Index last = kNone;
  for (std::size_t i = 0; i < curve.points.size(); ++i) {
    const Index v = nearest_corner(surface, curve.points[i]);
    const bool apart = i > 0 && (curve.pieces[i - 1].kind == PieceKind::gap ||
                                 curve.pieces[i - 1].kind == PieceKind::chord);
    if (i == 0 || apart) {
      push(v, curve.points[i], PieceKind::gap);
    } else if (v != last) {
      for (const Index w : edge_path(surface, last, v))
        push(w, curve.points[i], PieceKind::shortest);
    }
    last = v;
  }
  along.closed = curve.closed;
  return along;
}

}  // namespace mimicry
