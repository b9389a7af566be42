#include "segment/curve_network.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <string>

#include <mimicry/base/error.h>

#include "base/finite.h"
#include "geodesic/site.h"

namespace mimicry {
namespace {

using Kind = CutPlace::Kind;

[[noreturn]] void refuse(std::size_t curve, const std::string& what) {
  throw Error(ErrorKind::invalid_input, "curve " + std::to_string(curve) + ": " + what);
}

[[noreturn]] void refuse_edge(const Surface& surface, Index h, std::size_t curve,
                              const std::string& where) {
  refuse(curve, where + " passes the edge of vertices " +
                    std::to_string(surface.half_edges().tail(h)) + " and " +
                    std::to_string(surface.half_edges().head(h)) +
                    ", which has more than two faces; connect the mesh first, or draw around it");
}

void check_crossing(const Surface& surface, const Crossing& c, std::size_t curve,
                    std::size_t piece) {
  const std::string where = "piece " + std::to_string(piece);
  const HalfEdges& edges = surface.half_edges();
  if (c.half_edge < 0 || c.half_edge >= edges.count())
    refuse(curve, where + " crosses an edge that the mesh has not; it was drawn on another mesh");
  if (!std::isfinite(c.t) || c.t < 0.0 || c.t > 1.0)
    refuse(curve, where + " crosses an edge outside it; write the curve anew");
  if (edges.twin(c.half_edge) == HalfEdges::kNonManifold)
    refuse_edge(surface, c.half_edge, curve, where);
}

void check_curve(const Surface& surface, const ProjectedCurve& curve, std::size_t number,
                 double far) {
  const TriangleMesh& mesh = surface.mesh();
  if (curve.points.empty()) refuse(number, "it has no points; draw it, or leave it out");
  if (curve.points.size() == 1)
    refuse(number, "it has a single point, which cuts nothing; draw on, or leave it out");
  if (curve.pieces.size() + 1 != curve.points.size())
    refuse(number, std::to_string(curve.pieces.size()) + " pieces for " +
                       std::to_string(curve.points.size()) + " points; write the curve anew");
  for (std::size_t i = 0; i < curve.points.size(); ++i) {
    const CurvePoint& p = curve.points[i];
    const std::string what = "curve " + std::to_string(number) + ": point " + std::to_string(i);
    check_surface_point(mesh, p.surface, what);
    if (repeats_corner(mesh.face(p.surface.face)))
      refuse(number, "point " + std::to_string(i) + " lies in face " +
                         std::to_string(p.surface.face) +
                         ", which is no part of the surface; draw it anew");
    if (!is_finite(mesh.position(p.surface)))
      refuse(number, "point " + std::to_string(i) + " lies in face " +
                         std::to_string(p.surface.face) +
                         ", which has a vertex that is not finite; repair the mesh");
    if (!((mesh.position(p.surface) - p.position).norm() <= far))
      refuse(number, "point " + std::to_string(i) +
                         " lies elsewhere on this mesh than its position says; it was drawn on "
                         "another mesh");
  }
  for (std::size_t i = 0; i < curve.pieces.size(); ++i) {
    const Piece& piece = curve.pieces[i];
    if (piece.first_crossing > curve.crossings.size() ||
        piece.crossing_count > curve.crossings.size() - piece.first_crossing)
      refuse(number, "piece " + std::to_string(i) +
                         " names crossings that the curve has not; write the curve anew");
    for (const Crossing& c : curve.piece_crossings(i)) check_crossing(surface, c, number, i);
  }
}

// Without its gaps and chords the curve is connected over the mesh, or it is another mesh's.
void check_connected(const ProjectedCurve& curve, const RefinedCurve& refined, std::size_t number) {
  const auto apart = [](const Piece& p) {
    return p.kind == PieceKind::gap || p.kind == PieceKind::chord;
  };
  const auto gaps =
      static_cast<std::size_t>(std::count_if(curve.pieces.begin(), curve.pieces.end(), apart));
  if (refined.parts.size() == gaps + 1) return;
  for (std::size_t i = 0; i < curve.pieces.size(); ++i) {
    if (apart(curve.pieces[i])) continue;
    for (std::size_t n = refined.point_nodes[i]; n < refined.point_nodes[i + 1]; ++n)
      if (refined.faces[n] == kNone)
        refuse(number, "piece " + std::to_string(i) +
                           " is not connected over this mesh; it was drawn on another mesh, "
                           "or in a face without area");
  }
  refuse(number,
         "it is not connected over this mesh; it was drawn on another mesh, "
         "or in a face without area");
}

class Snapper {
 public:
  Snapper(const Surface& surface, double snap)
      : surface_(surface),
        snap_(snap),
        steps_(static_cast<std::int64_t>(snap * static_cast<double>(kCutGrid))) {}

  CutPlace place(const SurfacePoint& point) const {
    Vec3 b = point.bary;
    for (int k = 0; k < 3; ++k)
      if (b[k] < snap_) b[k] = 0.0;
    b /= b.sum();
    std::array<std::int64_t, 3> g{};
    for (std::size_t k = 0; k < 3; ++k)
      g[k] = std::llround(b[static_cast<int>(k)] * static_cast<double>(kCutGrid));
    const HalfEdges& edges = surface_.half_edges();
    const Face& face = surface_.mesh().face(point.face);
    for (std::size_t k = 0; k < 3; ++k)
      if (g[(k + 1) % 3] == 0 && g[(k + 2) % 3] == 0) return {Kind::vertex, face[k], {}};
    for (std::size_t k = 0; k < 3; ++k) {
      if (g[(k + 2) % 3] != 0) continue;
      const Index h = 3 * point.face + static_cast<Index>(k);
      const Index edge = edges.edge(h);
      return {Kind::edge, edge, {edge == h ? g[k + 1 == 3 ? 0 : k + 1] : g[k], 0}};
    }
    // The three need not sum to the grid: the first is what is left.
    return {Kind::face, point.face, {g[1], g[2]}};
  }

  // Of places on one edge that lie closer together than the tolerance the first stands for all;
  // in a face those of one neighbourhood.
  void merge(std::vector<std::vector<CutStep>>& curves) {
    std::vector<CutPlace> places;
    for (const auto& curve : curves)
      for (const CutStep& step : curve)
        if (step.place.kind != Kind::vertex) places.push_back(step.place);
    std::sort(places.begin(), places.end());
    places.erase(std::unique(places.begin(), places.end()), places.end());
    std::vector<CutPlace> merged = places;
    Index face = kNone;
    std::map<std::pair<std::int64_t, std::int64_t>, std::vector<CutPoint>> cells;
    for (std::size_t i = 0; i < places.size(); ++i) {
      if (places[i].kind == Kind::edge) {
        if (i > 0 && merged[i - 1].where == places[i].where && merged[i - 1].kind == Kind::edge &&
            places[i].p.x - merged[i - 1].p.x <= steps_)
          merged[i] = merged[i - 1];
        continue;
      }
      if (places[i].where != face) cells.clear();
      face = places[i].where;
      merged[i].p = near_point(cells, places[i].p);
    }
    for (auto& curve : curves)
      for (CutStep& step : curve) {
        if (step.place.kind == Kind::vertex) continue;
        const auto found = std::lower_bound(places.begin(), places.end(), step.place);
        step.place = merged[static_cast<std::size_t>(found - places.begin())];
      }
  }

 private:
  CutPoint near_point(std::map<std::pair<std::int64_t, std::int64_t>, std::vector<CutPoint>>& cells,
                      const CutPoint& p) const {
    const std::int64_t size = std::max<std::int64_t>(steps_, 1);
    const std::int64_t cx = p.x / size, cy = p.y / size;
    for (std::int64_t x = cx - 1; x <= cx + 1; ++x)
      for (std::int64_t y = cy - 1; y <= cy + 1; ++y) {
        const auto cell = cells.find({x, y});
        if (cell == cells.end()) continue;
        for (const CutPoint& q : cell->second)
          if (std::abs(q.x - p.x) <= steps_ && std::abs(q.y - p.y) <= steps_) return q;
      }
    cells[{cx, cy}].push_back(p);
    return p;
  }

  const Surface& surface_;
  double snap_;
  std::int64_t steps_;
};

// The edge of the face that both places lie on, as its half-edge there; kNone.
Index common_edge(const Surface& surface, Index face, const CutPlace& a, const CutPlace& b) {
  const HalfEdges& edges = surface.half_edges();
  const auto on = [&](const CutPlace& p, Index h) {
    if (p.kind == Kind::vertex) return p.where == edges.tail(h) || p.where == edges.head(h);
    return p.kind == Kind::edge && p.where == edges.edge(h);
  };
  for (Index h = 3 * face; h < 3 * face + 3; ++h)
    if (on(a, h) && on(b, h)) return h;
  return kNone;
}

std::int64_t along_edge(const HalfEdges& edges, Index edge, const CutPlace& p) {
  if (p.kind == Kind::edge) return p.p.x;
  return p.where == edges.tail(edge) ? 0 : kCutGrid;
}

void add_ways(const Surface& surface, const std::vector<CutStep>& curve, CurveNetwork& network) {
  for (std::size_t i = 0; i + 1 < curve.size(); ++i) {
    const Index face = curve[i].face;
    if (face == kNone) continue;
    const CutPlace &a = curve[i].place, &b = curve[i + 1].place;
    if (common_edge(surface, face, a, b) == kNone) {
      network.face_ways.push_back({face, std::min(a, b), std::max(a, b)});
      continue;
    }
    network.edge_ways.push_back(edge_way(surface, face, a, b));
  }
}

// Leaves out places that repeat the one before, and those on a straight way along one edge: a curve
// that is drawn along it and strays to both sides adds nothing to it.
std::vector<CutStep> without_idle_steps(const Surface& surface, const std::vector<CutStep>& curve) {
  std::vector<CutStep> steps;
  const auto passes_straight = [&](const CutPlace& to) {
    if (steps.size() < 2) return false;
    const CutStep &a = steps[steps.size() - 2], &b = steps.back();
    if (a.face == kNone || b.face == kNone || b.place.kind != Kind::edge) return false;
    if (common_edge(surface, a.face, a.place, b.place) == kNone ||
        common_edge(surface, b.face, b.place, to) == kNone)
      return false;
    const EdgeWay one = edge_way(surface, a.face, a.place, b.place);
    const EdgeWay two = edge_way(surface, b.face, b.place, to);
    return one.edge == two.edge && (one.to == two.from || two.to == one.from);
  };
  for (const CutStep& step : curve) {
    if (!steps.empty() && steps.back().face != kNone && steps.back().place == step.place) {
      steps.back().face = step.face;
      continue;
    }
    if (passes_straight(step.place)) steps.pop_back();
    steps.push_back(step);
  }
  return steps;
}

CutPlace middle(const Surface& surface, Index face, const CutPlace& a, const CutPlace& b) {
  if (common_edge(surface, face, a, b) != kNone) {
    const EdgeWay way = edge_way(surface, face, a, b);
    return {Kind::edge, way.edge, {(way.from + way.to) / 2, 0}};
  }
  const CutPoint p = point_in_face(surface, face, a), q = point_in_face(surface, face, b);
  return {Kind::face, face, {(p.x + q.x) / 2, (p.y + q.y) / 2}};
}

// A slit of a single edge cannot be opened in a mesh, whose edges are known by their ends: where
// nothing else comes to them the way gets a place in its middle.
void halve_lone_ways(const Surface& surface, std::vector<std::vector<CutStep>>& curves) {
  std::map<CutPlace, std::set<CutPlace>> neighbors;
  for (const auto& curve : curves)
    for (std::size_t i = 0; i + 1 < curve.size(); ++i) {
      if (curve[i].face == kNone) continue;
      neighbors[curve[i].place].insert(curve[i + 1].place);
      neighbors[curve[i + 1].place].insert(curve[i].place);
    }
  for (auto& curve : curves)
    for (std::size_t i = 0; i + 1 < curve.size(); ++i) {
      const CutStep &a = curve[i], &b = curve[i + 1];
      if (a.face == kNone || neighbors[a.place].size() > 1 || neighbors[b.place].size() > 1)
        continue;
      const CutStep half{middle(surface, a.face, a.place, b.place), a.face};
      curve.insert(curve.begin() + static_cast<std::ptrdiff_t>(i) + 1, half);
      ++i;
    }
}

template <class T>
void sort_unique(std::vector<T>& values) {
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
}

}  // namespace

CutPoint point_in_face(const Surface& surface, Index face, const CutPlace& place) {
  if (place.kind == Kind::face) return place.p;
  const HalfEdges& edges = surface.half_edges();
  std::array<std::int64_t, 3> g{};
  for (Index h = 3 * face; h < 3 * face + 3; ++h) {
    const auto k = at(h - 3 * face);
    if (place.kind == Kind::vertex && edges.tail(h) == place.where) g[k] = kCutGrid;
    if (place.kind == Kind::edge && edges.edge(h) == place.where) {
      const std::int64_t t = edges.edge(h) == h ? place.p.x : kCutGrid - place.p.x;
      g[k] = kCutGrid - t;
      g[k == 2 ? 0 : k + 1] = t;
    }
  }
  return {g[1], g[2]};
}

EdgeWay edge_way(const Surface& surface, Index face, const CutPlace& a, const CutPlace& b) {
  const HalfEdges& edges = surface.half_edges();
  const Index edge = edges.edge(common_edge(surface, face, a, b));
  const std::int64_t from = along_edge(edges, edge, a), to = along_edge(edges, edge, b);
  return {edge, std::min(from, to), std::max(from, to)};
}

void require_cuttable(const Surface& surface, const ProjectedCurve& curve, std::size_t number,
                      double mesh_diagonal) {
  check_curve(surface, curve, number, 1e-3 * mesh_diagonal);
  check_connected(curve, refine(curve, surface), number);
}

CurveNetwork curve_network(const Surface& surface, std::span<const ProjectedCurve> curves,
                           double snap) {
  CurveNetwork network;
  Snapper snapper(surface, snap);
  for (std::size_t c = 0; c < curves.size(); ++c) {
    const RefinedCurve refined = refine(curves[c], surface);
    std::vector<CutStep>& steps = network.curves.emplace_back();
    for (std::size_t i = 0; i < refined.nodes.size(); ++i)
      steps.push_back({snapper.place(refined.nodes[i].point), refined.faces[i]});
  }
  snapper.merge(network.curves);
  for (auto& curve : network.curves) {
    curve = without_idle_steps(surface, curve);
  }
  halve_lone_ways(surface, network.curves);
  for (const auto& curve : network.curves) {
    for (std::size_t i = 0; i < curve.size(); ++i) {
      const bool used = curve[i].face != kNone || (i > 0 && curve[i - 1].face != kNone);
      if (!used) continue;
      if (curve[i].place.kind == Kind::edge) network.edge_places.push_back(curve[i].place);
      if (curve[i].place.kind == Kind::face) network.face_places.push_back(curve[i].place);
    }
    add_ways(surface, curve, network);
  }
  for (std::size_t c = 0; c < network.curves.size(); ++c)
    for (const CutStep& step : network.curves[c])
      if (step.place.kind == Kind::edge &&
          surface.half_edges().twin(step.place.where) == HalfEdges::kNonManifold)
        refuse_edge(surface, step.place.where, c, "it");
  sort_unique(network.edge_places);
  sort_unique(network.face_places);
  sort_unique(network.face_ways);
  sort_unique(network.edge_ways);
  return network;
}

}  // namespace mimicry
