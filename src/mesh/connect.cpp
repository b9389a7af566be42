#include <algorithm>
#include <memory>
#include <numeric>
#include <span>
#include <tuple>
#include <utility>

#include <mimicry/mesh/connect.h>

#include "base/float_traps.h"
#include "mesh/fans.h"
#include "mesh/findings.h"
#include "mesh/kept_faces.h"
#include "mesh/place_edges.h"
#include "mesh/places.h"

namespace mimicry {
namespace {

// The attributes of a mesh of which some faces are turned; shared where none is.
std::shared_ptr<const MeshAttributes> turned_attributes(const TriangleMesh& mesh,
                                                        const std::vector<bool>& turned) {
  if (!mesh.attributes() || std::find(turned.begin(), turned.end(), true) == turned.end())
    return mesh.attributes();
  auto own = std::make_shared<MeshAttributes>(*mesh.attributes());
  own->turn_faces(turned);
  return own;
}

// Puts a surface together: a vertex for each fan.
class Assembler {
 public:
  Assembler(const TriangleMesh& mesh, const std::vector<Index>& place, const KeptFaces& faces,
            const Fans& fans, ConnectReport& report)
      : mesh_(mesh), place_(place), faces_(faces), fans_(fans), report_(report) {}

  void count_edges(const PlaceEdges& edges) {
    EdgeNote split, joined, one_sided;
    for (std::size_t e = 0; e < edges.count(); ++e) {
      const std::span<const Index> edge = edges.edge(e);
      bool is_open = false, is_joined = false;
      for (const Index h : edge) {
        const Index t = fans_.twins[at(h)];
        is_open = is_open || t < 0;
        is_joined = is_joined || (t > h && edges.ends(h) != edges.ends(t));
      }
      const Index lowest = *std::min_element(edge.begin(), edge.end());
      if (is_joined) joined(lowest);
      if (edge.size() == 2 && is_open &&
          edges.runs_up(edge[0], faces_.turned) == edges.runs_up(edge[1], faces_.turned))
        one_sided(lowest);
      if (edge.size() > 2 && (is_open || shares_vertices_of_three(edges, edge))) split(lowest);
    }
    report_.split_edges = split.finding(mesh_);
    report_.joined_edges = joined.finding(mesh_);
    report_.one_sided_edges = one_sided.finding(mesh_);
  }

  // Three or more half-edges between the same two vertices by number.
  static bool shares_vertices_of_three(const PlaceEdges& edges, std::span<const Index> edge) {
    if (edge.size() < 3) return false;
    std::vector<std::pair<Index, Index>> ends;
    for (const Index h : edge) ends.push_back(edges.ends(h));
    std::sort(ends.begin(), ends.end());
    for (std::size_t i = 2; i < ends.size(); ++i)
      if (ends[i] == ends[i - 2]) return true;
    return false;
  }

  // Edges are met in the order of their places; the example is the one with the lowest half-edge.
  struct EdgeNote {
    Index count = 0, lowest = kNone;
    void operator()(Index h) {
      if (count++ == 0 || h < lowest) lowest = h;
    }
    EdgeFinding finding(const TriangleMesh& mesh) const {
      if (count == 0) return {};
      const Face& f = mesh.face(lowest / 3);
      return {count, f[at(lowest % 3)], f[at((lowest + 1) % 3)]};
    }
  };

  Connected surface() {
    // Vertices in the order of the lowest of the caller's that each joins.
    const Index corners = 3 * mesh_.face_count();
    const auto own = [&](Index c) { return mesh_.face(c / 3)[at(c % 3)]; };
    std::vector<Index> lowest(at(corners), kNone);  // of a fan, at its root
    for (Index c = 0; c < corners; ++c) {
      if (faces_.left_out[at(c / 3)]) continue;
      Index& v = lowest[at(fans_.fan[at(c)])];
      if (v == kNone || own(c) < v) v = own(c);
    }
    std::vector<std::pair<Index, Index>> fans;  // lowest vertex, root
    for (Index c = 0; c < corners; ++c)
      if (lowest[at(c)] != kNone) fans.emplace_back(lowest[at(c)], c);
    std::sort(fans.begin(), fans.end());
    Connected result;
    result.report = report_;
    if (fans.empty()) return result;  // no face has three places

    auto source = std::make_shared<MeshSource>();
    std::vector<Index> number(at(corners), kNone);
    std::vector<Vec3> positions;
    positions.reserve(fans.size());
    for (const auto& [v, root] : fans) {
      number[at(root)] = static_cast<Index>(positions.size());
      source->vertex.push_back(v);
      positions.push_back(mesh_.position(v));
    }
    source->surface_vertex.assign(at(mesh_.vertex_count()), kNone);
    std::vector<Face> faces(at(mesh_.face_count()), Face{0, 0, 0});
    for (Index f = 0; f < mesh_.face_count(); ++f) {
      if (faces_.left_out[at(f)]) continue;
      for (Index k = 0; k < 3; ++k) {
        const Index v = own(3 * f + k), s = number[at(fans_.fan[at(3 * f + k)])];
        faces[at(f)][at(k)] = s;
        Index& known = source->surface_vertex[at(v)];
        known = known == kNone ? s : std::min(known, s);
      }
      if (faces_.turned[at(f)]) std::swap(faces[at(f)][1], faces[at(f)][2]);
    }
    // Vertices of faces that are left out are where others at their place are.
    std::vector<Index> at_place(at(mesh_.vertex_count()), kNone);
    for (Index v = 0; v < mesh_.vertex_count(); ++v) {
      const Index s = source->surface_vertex[at(v)];
      Index& known = at_place[at(place_[at(v)])];
      if (s != kNone && (known == kNone || s < known)) known = s;
    }
    for (Index f = 0; f < mesh_.face_count(); ++f)
      for (const Index v : mesh_.face(f)) {
        Index& s = source->surface_vertex[at(v)];
        if (s == kNone) s = at_place[at(place_[at(v)])];
      }
    for (Index f = 0; f < mesh_.face_count(); ++f) {
      if (!faces_.left_out[at(f)]) continue;
      const Index s = source->surface_vertex[at(mesh_.face(f)[0])];
      faces[at(f)].fill(s == kNone ? 0 : s);
    }
    count_vertices(*source, number);

    std::vector<Index> polygons;
    if (mesh_.has_polygons())
      for (Index f = 0; f < mesh_.face_count(); ++f) polygons.push_back(mesh_.polygon(f));
    source->faces.assign(mesh_.faces().begin(), mesh_.faces().end());
    source->turned = faces_.turned;
    result.report = report_;
    result.mesh = TriangleMesh(std::move(positions), std::move(faces), std::move(polygons));
    result.mesh.set_source(std::move(source));
    result.mesh.set_attributes(turned_attributes(mesh_, faces_.turned));
    result.half_edges = HalfEdges(result.mesh);
    return result;
  }

  void count_vertices(const MeshSource& source, const std::vector<Index>& number) {
    // Pairs (the caller's vertex, the surface's), each once.
    std::vector<std::pair<Index, Index>> uses;
    for (Index c = 0; c < 3 * mesh_.face_count(); ++c)
      if (!faces_.left_out[at(c / 3)])
        uses.emplace_back(mesh_.face(c / 3)[at(c % 3)], number[at(fans_.fan[at(c)])]);
    std::sort(uses.begin(), uses.end());
    uses.erase(std::unique(uses.begin(), uses.end()), uses.end());
    for (std::size_t i = 0; i < uses.size(); ++i) {
      const auto& [v, s] = uses[i];
      if (source.vertex[at(s)] != v && (i == 0 || uses[i - 1].first != v))
        note(report_.joined_vertices, v);
      if (i > 0 && uses[i - 1].first == v && (i == 1 || uses[i - 2].first != v))
        note(report_.split_vertices, v);
    }
    std::vector<bool> named(at(mesh_.vertex_count()), false);
    for (const Face& f : mesh_.faces())
      for (const Index v : f) named[at(v)] = true;
    for (Index v = 0; v < mesh_.vertex_count(); ++v)
      if (!named[at(v)]) note(report_.unused_vertices, v);
  }

 private:
  const TriangleMesh& mesh_;
  const std::vector<Index>& place_;
  const KeptFaces& faces_;
  const Fans& fans_;
  ConnectReport& report_;
};

Connected make_surface(const TriangleMesh& mesh, const std::vector<Index>& place) {
  ConnectReport report;
  const KeptFaces faces = keep_faces(mesh, place, report);
  const PlaceEdges edges(mesh, place, faces.left_out);
  const Fans fans = find_fans(mesh, place, edges, faces);
  Assembler assembler(mesh, place, faces, fans, report);
  assembler.count_edges(edges);
  return assembler.surface();
}

bool uses_all_vertices(const HalfEdges& half_edges, Index vertices) {
  for (Index v = 0; v < vertices; ++v)
    if (half_edges.outgoing(v) < 0) return false;
  return true;
}

bool any_repeats(const TriangleMesh& mesh) {
  return std::any_of(mesh.faces().begin(), mesh.faces().end(), repeats_corner);
}

// Whether a face may lie on a neighbour: a sheet from both sides can be a manifold.
bool any_folds(const TriangleMesh& mesh, const HalfEdges& half_edges) {
  for (Index h = 0; h < half_edges.count(); ++h) {
    const Index t = half_edges.twin(h);
    if (t < h) continue;
    if (half_edges.head(HalfEdges::next(h)) == half_edges.head(HalfEdges::next(t))) return true;
    if (!mesh.has_polygons() || mesh.polygon(h / 3) == mesh.polygon(t / 3)) continue;
    const Vec3 a = mesh.area_vector(h / 3), b = mesh.area_vector(t / 3);
    if (a.dot(b) < 0.0 && a.cross(b).squaredNorm() <= 1e-12 * a.squaredNorm() * b.squaredNorm())
      return true;
  }
  return false;
}

// Boundary edges that lie where another boundary edge runs the other way.
EdgeFinding seams(const TriangleMesh& mesh, const HalfEdges& half_edges,
                  const std::vector<Index>& place) {
  std::vector<std::tuple<Index, Index, Index>> open;  // places up, half-edge
  for (Index h = 0; h < half_edges.count(); ++h) {
    if (half_edges.has_twin(h) || repeats_corner(mesh.face(h / 3))) continue;
    const auto [low, high] =
        std::minmax({place[at(half_edges.tail(h))], place[at(half_edges.head(h))]});
    open.emplace_back(low, high, h);
  }
  std::sort(open.begin(), open.end());
  EdgeFinding found;
  Index lowest = kNone;
  for (std::size_t i = 1; i < open.size(); ++i) {
    const auto& [low, high, h] = open[i];
    const auto& [other_low, other_high, other] = open[i - 1];
    if (low != other_low || high != other_high) continue;
    if (found.count++ == 0 || other < lowest) lowest = other;
  }
  if (found.count > 0) {
    found.first_tail = half_edges.tail(lowest);
    found.first_head = half_edges.head(lowest);
  }
  return found;
}

}  // namespace

Connected connect(TriangleMesh mesh, const ConnectOptions& options) {
  const FloatTrapMask mask;  // any numbers may stand in a mesh
  Connected result;
  result.half_edges = HalfEdges(mesh);
  const bool sound =
      result.half_edges.is_manifold() && uses_all_vertices(result.half_edges, mesh.vertex_count());
  const bool done = sound && mesh.is_connected();
  std::vector<Index> place;
  bool shared = false;
  if (!done) {
    place = equal_places(mesh.positions());
    for (std::size_t v = 0; v < place.size() && !shared; ++v)
      shared = place[v] != static_cast<Index>(v);
  }
  if (!done && (!sound || any_repeats(mesh) || (shared && options.join) ||
                any_folds(mesh, result.half_edges))) {
    if (!options.join) std::iota(place.begin(), place.end(), Index{0});
    Connected made = make_surface(mesh, place);
    const bool changed =
        made.mesh.vertex_count() != mesh.vertex_count() ||
        !std::equal(made.mesh.faces().begin(), made.mesh.faces().end(), mesh.faces().begin());
    result.report = made.report;
    if (changed && made.mesh.vertex_count() > 0) {
      result.mesh = std::move(made.mesh);
      result.half_edges = std::move(made.half_edges);
    }
  }
  if (result.mesh.face_count() == 0) result.mesh = std::move(mesh);
  if (shared && !options.join)
    result.report.seam_edges =
        seams(result.mesh, result.half_edges, equal_places(result.mesh.positions()));
  result.mesh.mark_connected();
  return result;
}

}  // namespace mimicry
