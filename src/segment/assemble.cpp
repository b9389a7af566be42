#include "segment/assemble.h"

#include <algorithm>
#include <string>
#include <unordered_map>
#include <utility>

#include <mimicry/base/error.h>

#include "segment/corner_values.h"

namespace mimicry {
namespace {

using Kind = CutPlace::Kind;
using Pair = std::pair<Index, Index>;

Pair ordered(Index a, Index b) {
  return a < b ? Pair(a, b) : Pair(b, a);
}

// Cotangents of the angles at c and d sum to less than 0: the angles to more than pi (Delaunay's
// condition for the edge between a and b).
bool angles_exceed_pi(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const Vec3 ca = a - c, cb = b - c, da = a - d, db = b - d;
  const double c_sin = ca.cross(cb).norm(), d_sin = da.cross(db).norm();
  const double sum = ca.dot(cb) * d_sin + da.dot(db) * c_sin;
  return sum < -1e-9 * ca.norm() * cb.norm() * da.norm() * db.norm();
}

class Assembler {
 public:
  Assembler(const Surface& target, const CurveNetwork& network, const SegmentOptions& options)
      : target_(target),
        mesh_(target.mesh()),
        edges_(target.half_edges()),
        network_(network),
        options_(options),
        positions_(mesh_.positions().begin(), mesh_.positions().end()),
        chains_(network.face_ways.size()) {}

  Segmentation run() {
    place_vertices();
    const std::vector<bool> touched = touched_faces();
    const auto expected = at(mesh_.face_count()) + 8 * network_.edge_places.size();
    faces_.reserve(expected);
    cut_.parents.reserve(expected);
    cut_.barycentrics.reserve(expected);
    for (Index f = 0; f < mesh_.face_count(); ++f) {
      cut_.first_child.push_back(static_cast<Index>(faces_.size()));
      if (repeats_corner(mesh_.face(f))) continue;
      if (touched[at(f)])
        cut_face(f);
      else
        keep_face(f);
    }
    cut_.first_child.push_back(static_cast<Index>(faces_.size()));
    for (const EdgeWay& way : network_.edge_ways) {
      const std::vector<Index> chain = edge_chain(way);
      for (std::size_t i = 1; i < chain.size(); ++i)
        seams_.push_back(ordered(chain[i - 1], chain[i]));
    }
    make_surface();
    mark_seams();
    for (const auto& curve : network_.curves) cut_.seams.push_back(seam(curve));
    return std::move(cut_);
  }

 private:
  Index vertex_of(const CutPlace& place) const {
    if (place.kind == Kind::vertex) return place.where;
    const bool on_edge = place.kind == Kind::edge;
    const auto& places = on_edge ? network_.edge_places : network_.face_places;
    const auto found = std::lower_bound(places.begin(), places.end(), place);
    return mesh_.vertex_count() + static_cast<Index>(found - places.begin()) +
           (on_edge ? 0 : static_cast<Index>(network_.edge_places.size()));
  }

  // The places on an edge, in order along it.
  std::span<const CutPlace> places_on(Index edge) const {
    const auto range = std::equal_range(
        network_.edge_places.begin(), network_.edge_places.end(), CutPlace{Kind::edge, edge, {}},
        [](const CutPlace& a, const CutPlace& b) { return a.where < b.where; });
    return std::span(network_.edge_places)
        .subspan(static_cast<std::size_t>(range.first - network_.edge_places.begin()),
                 static_cast<std::size_t>(range.second - range.first));
  }

  void place_vertices() {
    for (const CutPlace& p : network_.edge_places) {
      const double t = static_cast<double>(p.p.x) / static_cast<double>(kCutGrid);
      positions_.push_back((1.0 - t) * mesh_.position(edges_.tail(p.where)) +
                           t * mesh_.position(edges_.head(p.where)));
    }
    for (const CutPlace& p : network_.face_places)
      positions_.push_back(mesh_.position(SurfacePoint{p.where, p.p.bary()}));
  }

  std::vector<bool> touched_faces() const {
    std::vector<bool> touched(at(mesh_.face_count()), false);
    for (const CutPlace& p : network_.edge_places) {
      touched[at(HalfEdges::face(p.where))] = true;
      if (edges_.has_twin(p.where)) touched[at(HalfEdges::face(edges_.twin(p.where)))] = true;
    }
    for (const CutPlace& p : network_.face_places) touched[at(p.where)] = true;
    for (Index f = 0; f < mesh_.face_count(); ++f)
      if (touched[at(f)]) refuse_twin(f);
    return touched;
  }

  // Edges are known by their ends: in two faces with the same corners those of a cut could not be
  // told apart.
  void refuse_twin(Index f) const {
    for (Index h = 3 * f; h < 3 * f + 3; ++h) {
      const Index twin = edges_.twin(h), next = edges_.twin(HalfEdges::next(h));
      if (twin < 0 || next < 0 || HalfEdges::face(twin) != HalfEdges::face(next)) continue;
      throw Error(ErrorKind::invalid_input,
                  "curves: they pass through faces " + std::to_string(f) + " and " +
                      std::to_string(HalfEdges::face(twin)) +
                      ", which have the same three corners; take one of them out of the mesh");
    }
  }

  void keep_face(Index f) {
    std::array<CutCorner, 3> corners;
    for (std::size_t k = 0; k < 3; ++k)
      corners[k] = {mesh_.face(f)[k], Vec3::Unit(static_cast<int>(k))};
    add_face(f, corners);
  }

  void add_face(Index parent, const std::array<CutCorner, 3>& corners) {
    faces_.push_back({corners[0].vertex, corners[1].vertex, corners[2].vertex});
    if (mesh_.attributes()) corners_.push_back(corners);
    cut_.parents.push_back(parent);
    cut_.barycentrics.push_back({corners[0].bary, corners[1].bary, corners[2].bary});
  }

  void cut_face(Index f) {
    FaceTriangulation pieces(
        static_cast<std::int64_t>(options_.snap * static_cast<double>(kCutGrid)));
    const Face& face = mesh_.face(f);
    std::vector<Index> vertices(face.begin(), face.end());
    const auto add = [&](const CutPlace& p) {
      pieces.add_point(point_in_face(target_, f, p));
      vertices.push_back(vertex_of(p));
    };
    for (Index h = 3 * f; h < 3 * f + 3; ++h)
      for (const CutPlace& p : places_on(edges_.edge(h))) add(p);
    const auto inside = std::equal_range(
        network_.face_places.begin(), network_.face_places.end(), CutPlace{Kind::face, f, {}},
        [](const CutPlace& a, const CutPlace& b) { return a.where < b.where; });
    for (auto p = inside.first; p != inside.second; ++p) add(*p);

    std::unordered_map<Index, Index> local;
    for (std::size_t i = 0; i < vertices.size(); ++i) local[vertices[i]] = static_cast<Index>(i);
    const auto ways =
        std::equal_range(network_.face_ways.begin(), network_.face_ways.end(), FaceWay{f, {}, {}},
                         [](const FaceWay& a, const FaceWay& b) { return a.face < b.face; });
    const auto ends = [&](const FaceWay& way) {
      return Pair(local.at(vertex_of(way.from)), local.at(vertex_of(way.to)));
    };
    for (auto way = ways.first; way != ways.second; ++way) {
      pieces.add_segment(ends(*way).first, ends(*way).second);
      if (cut_.crossings + pieces.crossings() > options_.most_crossings)
        throw Error(ErrorKind::invalid_input,
                    "curves: they cross in more than " + std::to_string(options_.most_crossings) +
                        " places (in face " + std::to_string(f) +
                        " and before it); draw less, or cut in several steps");
    }
    cut_.crossings += pieces.crossings();
    for (std::size_t i = vertices.size(); i < pieces.points().size(); ++i) {
      vertices.push_back(static_cast<Index>(positions_.size()));
      positions_.push_back(mesh_.position(SurfacePoint{f, pieces.points()[i].bary()}));
    }
    for (auto way = ways.first; way != ways.second; ++way)
      for (const Index v : pieces.chain(ends(*way).first, ends(*way).second))
        chains_[static_cast<std::size_t>(way - network_.face_ways.begin())].push_back(
            vertices[at(v)]);
    const auto x = [&](Index v) -> const Vec3& { return positions_[at(vertices[at(v)])]; };
    pieces.improve([&](Index a, Index b, Index c, Index d) {
      return angles_exceed_pi(x(a), x(b), x(c), x(d));
    });
    emit(f, pieces, vertices);
  }

  void emit(Index f, const FaceTriangulation& pieces, const std::vector<Index>& vertices) {
    for (const FaceTriangulation::Triangle& t : pieces.triangles()) {
      std::array<CutCorner, 3> corners;
      for (std::size_t k = 0; k < 3; ++k) {
        corners[k] = {vertices[at(t.v[k])], pieces.points()[at(t.v[k])].bary()};
        if (t.fixed[k])
          seams_.push_back(ordered(vertices[at(t.v[k])], vertices[at(t.v[(k + 1) % 3])]));
      }
      add_face(f, corners);
    }
  }

  std::vector<Index> edge_chain(const EdgeWay& way) const {
    std::vector<Index> chain;
    if (way.from == 0) chain.push_back(edges_.tail(way.edge));
    for (const CutPlace& p : places_on(way.edge))
      if (p.p.x >= way.from && p.p.x <= way.to) chain.push_back(vertex_of(p));
    if (way.to == kCutGrid) chain.push_back(edges_.head(way.edge));
    return chain;
  }

  void make_surface() {
    std::vector<Index> polygons;
    if (mesh_.has_polygons())
      for (const Index parent : cut_.parents) polygons.push_back(mesh_.polygon(parent));
    TriangleMesh mesh(std::move(positions_), std::move(faces_), std::move(polygons));
    if (mesh_.attributes())
      mesh.set_attributes(cut_attributes(*mesh_.attributes(), edges_, cut_.parents, corners_));
    mesh.mark_connected();
    cut_.surface = Surface::as_given(std::move(mesh));
  }

  void mark_seams() {
    const HalfEdges& edges = cut_.surface.half_edges();
    std::sort(seams_.begin(), seams_.end());
    std::vector<bool> near(at(cut_.surface.mesh().vertex_count()), false);
    for (const auto& [a, b] : seams_) near[at(a)] = near[at(b)] = true;
    cut_.seam_edges.assign(at(edges.count()), false);
    for (Index h = 0; h < edges.count(); ++h)
      if (near[at(edges.tail(h))] && near[at(edges.head(h))])
        cut_.seam_edges[at(h)] =
            std::binary_search(seams_.begin(), seams_.end(), ordered(edges.tail(h), edges.head(h)));
  }

  // The vertices from a step's place to the next one's, both included.
  std::vector<Index> way_chain(const CutStep& step, const CutPlace& to) const {
    std::vector<Index> chain;
    const FaceWay way{step.face, std::min(step.place, to), std::max(step.place, to)};
    const auto found = std::lower_bound(network_.face_ways.begin(), network_.face_ways.end(), way);
    if (found != network_.face_ways.end() && *found == way)
      chain = chains_[static_cast<std::size_t>(found - network_.face_ways.begin())];
    else
      chain = edge_chain(edge_way(target_, step.face, step.place, to));
    if (!chain.empty() && chain.front() != vertex_of(step.place))
      std::reverse(chain.begin(), chain.end());
    return chain;
  }

  CurvePoint point_at(Index half_edge, int k) const {
    const Surface& surface = cut_.surface;
    const SurfacePoint p{HalfEdges::face(half_edge),
                         Vec3::Unit((HalfEdges::corner(half_edge) + k) % 3)};
    CurvePoint point;
    point.surface = p;
    point.position = surface.position(p);
    point.normal = surface.normal(p);
    return point;
  }

  Index half_edge_between(Index a, Index b) const {
    const HalfEdges& edges = cut_.surface.half_edges();
    for (const auto& [from, to] : {Pair(a, b), Pair(b, a)}) {
      const Index first = edges.outgoing(from);
      for (Index h = first; h >= 0;) {
        if (edges.head(h) == to) return h;
        h = edges.ccw(h);
        if (h == first) break;
      }
    }
    return kNone;
  }

  ProjectedCurve seam(const std::vector<CutStep>& steps) const {
    ProjectedCurve curve;
    bool joined = false;
    Index first = kNone, last = kNone;
    for (std::size_t i = 0; i + 1 < steps.size(); ++i) {
      if (steps[i].face == kNone) {
        joined = false;
        continue;
      }
      const std::vector<Index> chain = way_chain(steps[i], steps[i + 1].place);
      for (std::size_t k = 1; k < chain.size(); ++k) {
        const Index h = half_edge_between(chain[k - 1], chain[k]);
        if (h == kNone) continue;
        const bool along = cut_.surface.half_edges().tail(h) == chain[k - 1];
        if (!joined) {
          if (!curve.points.empty()) curve.pieces.push_back({});
          curve.points.push_back(point_at(h, along ? 0 : 1));
          if (first == kNone) first = chain[k - 1];
          joined = true;
        }
        curve.points.push_back(point_at(h, along ? 1 : 0));
        const auto n = curve.points.size();
        // Straight through space: no way is shorter.
        curve.pieces.push_back(
            {PieceKind::shortest,
             (curve.points[n - 1].position - curve.points[n - 2].position).norm(), 0, 0});
        last = chain[k];
      }
    }
    curve.closed = curve.points.size() > 2 && first == last;
    return curve;
  }

  const Surface& target_;
  const TriangleMesh& mesh_;
  const HalfEdges& edges_;
  const CurveNetwork& network_;
  const SegmentOptions& options_;
  std::vector<Vec3> positions_;
  std::vector<Face> faces_;
  std::vector<std::array<CutCorner, 3>> corners_;  // where there are attributes
  std::vector<std::vector<Index>> chains_;         // of face ways, in vertices
  std::vector<Pair> seams_;                        // edges of the cut mesh, lower vertex first
  Segmentation cut_;
};

}  // namespace

Segmentation assemble(const Surface& target, const CurveNetwork& network,
                      const SegmentOptions& options) {
  return Assembler(target, network, options).run();
}

}  // namespace mimicry
