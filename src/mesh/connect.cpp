#include <algorithm>
#include <memory>
#include <numeric>
#include <span>
#include <tuple>
#include <utility>

#include <mimicry/base/float_traps.h>
#include <mimicry/mesh/connect.h>

#include "mesh/edge_pairs.h"
#include "mesh/places.h"
#include "mesh/sets.h"

namespace mimicry {
namespace {

template <class Finding>
void note(Finding& finding, Index i) {
  if (finding.count++ == 0 || i < finding.first) finding.first = i;
}

// All half-edges of live faces, those between the same two places beside each other.
class PlaceEdges {
 public:
  PlaceEdges(const TriangleMesh& mesh, const std::vector<Index>& place,
             const std::vector<bool>& left_out)
      : mesh_(mesh), place_(place) {
    // By the smaller place into buckets, then each small bucket by the other.
    std::vector<Index> start(place.size() + 1, 0);
    const auto each = [&](auto&& visit) {
      for (Index h = 0; h < 3 * mesh.face_count(); ++h)
        if (!left_out[at(h / 3)]) visit(h, std::minmax({place[at(tail(h))], place[at(head(h))]}));
    };
    each([&](Index, std::pair<Index, Index> ends) { ++start[at(ends.first) + 1]; });
    for (std::size_t v = 0; v < place.size(); ++v) start[v + 1] += start[v];
    std::vector<std::pair<Index, Index>> keyed(at(start.back()));
    std::vector<Index> fill(start.begin(), start.end() - 1);
    each([&](Index h, std::pair<Index, Index> ends) {
      keyed[at(fill[at(ends.first)]++)] = {ends.second, h};
    });
    half_edges_.reserve(keyed.size());
    for (std::size_t v = 0; v < place.size(); ++v) {
      const auto first = keyed.begin() + start[v], last = keyed.begin() + start[v + 1];
      std::sort(first, last);
      for (auto it = first; it != last; ++it) {
        if (it == first || it->first != (it - 1)->first) runs_.push_back(half_edges_.size());
        half_edges_.push_back(it->second);
      }
    }
    runs_.push_back(half_edges_.size());
  }

  std::size_t count() const { return runs_.size() - 1; }
  std::span<const Index> edge(std::size_t i) const {
    return {half_edges_.data() + runs_[i], runs_[i + 1] - runs_[i]};
  }
  Index tail(Index h) const { return mesh_.face(h / 3)[at(h % 3)]; }
  Index head(Index h) const { return mesh_.face(h / 3)[at((h + 1) % 3)]; }
  // From the lower place to the higher, in the order of the face's own corners.
  bool runs_up(Index h) const { return place_[at(tail(h))] < place_[at(head(h))]; }

 private:
  const TriangleMesh& mesh_;
  const std::vector<Index>& place_;
  std::vector<Index> half_edges_;
  std::vector<std::size_t> runs_;
};

class Connector {
 public:
  Connector(const TriangleMesh& mesh, std::vector<Index> place)
      : mesh_(mesh),
        place_(std::move(place)),
        left_out_(at(mesh.face_count()), false),
        turned_(at(mesh.face_count()), false),
        part_(at(mesh.face_count()), kNone),
        twins_(at(mesh.face_count()) * 3, kNone) {}

  Connected run() {
    leave_out_collapsed_faces();
    leave_out_doubles_and_turn();
    const PlaceEdges edges(mesh_, place_, left_out_);
    pair_half_edges(edges);
    find_fans();
    while (separate(edges)) find_fans();
    count_edges(edges);
    return surface();
  }

 private:
  // Where doubles are gone, or faces were turned, others may no longer wall anything off.
  void leave_out_doubles_and_turn() {
    constexpr int kMostRounds = 16;
    bool any = true;
    for (int round = 0; round < kMostRounds && any; ++round) {
      any = turn_faces(PlaceEdges(mesh_, place_, left_out_));
      any |= leave_out_doubles();
    }
    for (Index f = 0; f < mesh_.face_count(); ++f)
      if (turned_[at(f)]) note(report_.turned_faces, f);
  }

  void leave_out_collapsed_faces() {
    for (Index f = 0; f < mesh_.face_count(); ++f)
      if (repeats_corner(places_of(f))) {
        left_out_[at(f)] = true;
        note(report_.repeated_corners, f);
      }
  }

  Face places_of(Index f) const {
    const Face& face = mesh_.face(f);
    return {place_[at(face[0])], place_[at(face[1])], place_[at(face[2])]};
  }

  // Whether as many faces run one way along the edge as the other.
  bool is_balanced(const PlaceEdges& edges, std::span<const Index> edge) const {
    std::ptrdiff_t up = 0;
    for (const Index h : edge) up += runs_up(edges, h) ? 1 : -1;
    return up == 0;
  }

  // The places of a polygon's corners, sorted; empty where a face of it is left out.
  std::vector<Index> outline(Index first, Index end) const {
    std::vector<Index> places;
    for (Index f = first; f < end; ++f) {
      if (left_out_[at(f)]) return {};
      for (const Index v : mesh_.face(f)) places.push_back(place_[at(v)]);
    }
    std::sort(places.begin(), places.end());
    places.erase(std::unique(places.begin(), places.end()), places.end());
    return places;
  }

  // For each face of a polygon that lies where an earlier one does (the same corners, however it
  // is cut into triangles, from either side) the first face of that one; else kNone.
  std::vector<Index> copies() const {
    struct Polygon {
      std::vector<Index> places;
      Index first, end;
    };
    std::vector<Polygon> polygons;
    for (Index first = 0; first < mesh_.face_count();) {
      Index end = first + 1;
      while (end < mesh_.face_count() && mesh_.polygon(end) == mesh_.polygon(first)) ++end;
      if (std::vector<Index> places = outline(first, end); !places.empty())
        polygons.push_back({std::move(places), first, end});
      first = end;
    }
    std::sort(polygons.begin(), polygons.end(), [](const Polygon& a, const Polygon& b) {
      return std::tie(a.places, a.first) < std::tie(b.places, b.first);
    });
    std::vector<Index> copy_of(at(mesh_.face_count()), kNone);
    for (std::size_t i = 1, original = 0; i < polygons.size(); ++i) {
      const Polygon &one = polygons[original], &other = polygons[i];
      if (one.places != other.places || one.end - one.first != other.end - other.first) {
        original = i;
        continue;
      }
      for (Index f = other.first; f < other.end; ++f) copy_of[at(f)] = one.first;
    }
    return copy_of;
  }

  // False where there were none to leave out.
  bool leave_out_doubles() {
    const std::vector<Index> copy_of = copies();
    if (std::all_of(copy_of.begin(), copy_of.end(), [](Index f) { return f == kNone; }))
      return false;

    // A sheet of doubles is a wall between solids, and stays, where its edges had their faces in
    // pairs and would be left with three or more. What has a free edge, where the double meets but
    // its original, walls nothing off.
    const PlaceEdges edges(mesh_, place_, left_out_);
    Sets sheets(mesh_.face_count());
    std::vector<Index> walls, free;
    for (std::size_t e = 0; e < edges.count(); ++e) {
      const std::span<const Index> edge = edges.edge(e);
      Index first = kNone;
      std::size_t stay = 0;
      for (const Index h : edge) {
        if (copy_of[at(h / 3)] == kNone)
          ++stay;
        else if (first == kNone)
          first = h / 3;
        else
          sheets.join(first, h / 3);
      }
      if (first == kNone) continue;
      if (stay > 2 && is_balanced(edges, edge)) walls.push_back(first);
      const Index other = edge[0] / 3 == first ? edge.back() / 3 : edge[0] / 3;
      if (stay == 1 && edge.size() == 2 &&
          mesh_.polygon(copy_of[at(first)]) == mesh_.polygon(other))
        free.push_back(first);
    }
    std::vector<bool> is_wall(at(mesh_.face_count()), false);
    for (const Index f : walls) is_wall[at(sheets.root(f))] = true;
    for (const Index f : free) is_wall[at(sheets.root(f))] = false;
    bool any = false;
    DuplicateFinding& found = report_.doubled_faces;
    for (Index f = 0; f < mesh_.face_count(); ++f) {
      if (copy_of[at(f)] == kNone || is_wall[at(sheets.root(f))]) continue;
      left_out_[at(f)] = any = true;
      if (found.count++ > 0 && f > found.first) continue;
      found.first = f;
      found.first_copy_of = copy_of[at(f)];
    }
    return any;
  }

  // Six times the volume of a tetrahedron, seen from the first corner of a part's first face.
  double volume_below(Index f, Index part) const {
    const Vec3& origin = mesh_.corner(part, 0);
    const Vec3 b = mesh_.corner(f, 1) - origin, c = mesh_.corner(f, 2) - origin;
    const double volume = (mesh_.corner(f, 0) - origin).dot(b.cross(c));
    return turned_[at(f)] ? -volume : volume;
  }

  // The runs of an edge's half-edges that share both vertices by number, lowest first.
  template <class Visit>
  static void by_number(const PlaceEdges& edges, std::span<const Index> edge,
                        std::vector<Index>& sorted, Visit&& visit) {
    sorted.assign(edge.begin(), edge.end());
    const auto ends = [&](Index h) { return std::minmax({edges.tail(h), edges.head(h)}); };
    std::sort(sorted.begin(), sorted.end(),
              [&](Index a, Index b) { return std::tuple(ends(a), a) < std::tuple(ends(b), b); });
    for (std::size_t i = 0; i < sorted.size();) {
      std::size_t end = i + 1;
      while (end < sorted.size() && ends(sorted[end]) == ends(sorted[i])) ++end;
      visit(std::span<const Index>(sorted.data() + i, end - i));
      i = end;
    }
  }

  // Edges of two faces, by number and then by place, tell whether these agree; a part is what they
  // join. False where all do.
  bool turn_faces(const PlaceEdges& edges) {
    Sets parts(mesh_.face_count());
    std::vector<Index> against;   // a face of each edge whose faces run against each other
    std::vector<Index> contrary;  // the same where turning faces would not mend it
    std::vector<Index> open;      // faces with an edge that joins no two
    const auto join = [&](Index a, Index b) {
      const bool against_each_other = runs_up(edges, a) == runs_up(edges, b);
      if (against_each_other) against.push_back(a / 3);
      if (!parts.join(a / 3, b / 3, against_each_other)) contrary.push_back(a / 3);
    };
    std::vector<Index> sorted;
    for (std::size_t e = 0; e < edges.count(); ++e)
      by_number(edges, edges.edge(e), sorted, [&](std::span<const Index> run) {
        if (run.size() == 2) join(run[0], run[1]);
      });
    for (std::size_t e = 0; e < edges.count(); ++e) {
      const std::span<const Index> edge = edges.edge(e);
      by_number(edges, edge, sorted, [&](std::span<const Index> run) {
        if (run.size() == 2) return;
        if (edge.size() == 2 && run[0] == edge[0]) join(edge[0], edge[1]);
        if (edge.size() != 2)
          for (const Index h : run) open.push_back(h / 3);
      });
    }
    for (Index f = 0; f < mesh_.face_count(); ++f) part_[at(f)] = parts.root(f);
    if (against.empty()) return false;
    struct Part {
      bool closed = true;
      Index against = 0, contrary = 0, as_root = 0, against_root = 0;
      double volume = 0.0;  // six times, with all faces as the root's
    };
    std::vector<Part> all(at(mesh_.face_count()));
    const auto part = [&](Index f) -> Part& { return all[at(part_[at(f)])]; };
    for (const Index f : against) ++part(f).against;
    for (const Index f : contrary) ++part(f).contrary;
    for (const Index f : open) part(f).closed = false;
    for (Index f = 0; f < mesh_.face_count(); ++f) {
      if (left_out_[at(f)] || part(f).against == 0) continue;
      const Sets::Root root = parts.find(f);
      ++(root.odd ? part(f).against_root : part(f).as_root);
      part(f).volume += (root.odd ? -1.0 : 1.0) * volume_below(f, root.root);
    }
    bool any = false;
    for (Index f = 0; f < mesh_.face_count(); ++f) {
      const Part& p = part(f);
      // Of a one-sided part only what gets better by it.
      if (left_out_[at(f)] || p.against <= p.contrary) continue;
      const bool closed = p.closed && p.contrary == 0 && p.volume != 0.0;
      const bool root_turns = closed ? p.volume < 0.0 : p.against_root > p.as_root;
      if (parts.find(f).odd == root_turns) continue;
      turned_[at(f)] = !turned_[at(f)];
      any = true;
    }
    return any;
  }

  bool runs_up(const PlaceEdges& edges, Index h) const {
    return edges.runs_up(h) != turned_[at(h / 3)];
  }

  void pair(Index a, Index b) {
    twins_[at(a)] = b;
    twins_[at(b)] = a;
  }

  void pair_half_edges(const PlaceEdges& edges) {
    std::vector<EdgeSide> rest;
    std::vector<Index> sorted;
    for (std::size_t e = 0; e < edges.count(); ++e) {
      // Neighbours by number first.
      rest.clear();
      by_number(edges, edges.edge(e), sorted, [&](std::span<const Index> run) {
        if (run.size() == 2 && runs_up(edges, run[0]) != runs_up(edges, run[1]))
          pair(run[0], run[1]);
        else
          for (const Index h : run) rest.push_back({h, runs_up(edges, h)});
      });
      if (rest.size() > 2) pair_own_parts(rest);
      std::sort(rest.begin(), rest.end(),
                [](const EdgeSide& a, const EdgeSide& b) { return a.h < b.h; });
      for (const auto& [a, b] : pair_sides(mesh_, turned_, rest)) pair(a, b);
    }
  }

  // The two faces of a part that comes to this edge with two are neighbours: bodies and sheets that
  // touch others there go on.
  void pair_own_parts(std::vector<EdgeSide>& sides) {
    const auto part = [this](const EdgeSide& side) { return part_[at(side.h / 3)]; };
    std::sort(sides.begin(), sides.end(), [&](const EdgeSide& a, const EdgeSide& b) {
      return std::tuple(part(a), a.h) < std::tuple(part(b), b.h);
    });
    std::vector<EdgeSide> rest;
    for (std::size_t i = 0; i < sides.size();) {
      std::size_t end = i + 1;
      while (end < sides.size() && part(sides[end]) == part(sides[i])) ++end;
      if (end - i == 2 && sides[i].forward != sides[i + 1].forward)
        pair(sides[i].h, sides[i + 1].h);
      else
        rest.insert(rest.end(), sides.begin() + static_cast<std::ptrdiff_t>(i),
                    sides.begin() + static_cast<std::ptrdiff_t>(end));
      i = end;
    }
    sides = std::move(rest);
  }

  // Corner 3 f + k in the order of the file's corners; half-edge h leaves corner h of a face that
  // is not turned. What one half-edge leaves the other runs to.
  static Index next_corner(Index c) { return HalfEdges::next(c); }

  void find_fans() {
    Sets fans(3 * mesh_.face_count());
    for (Index h = 0; h < 3 * mesh_.face_count(); ++h) {
      const Index t = twins_[at(h)];
      if (t < h) continue;
      // By place, so that it holds for turned faces, too.
      const bool same_way = place_of_corner(h) == place_of_corner(t);
      fans.join(h, same_way ? t : next_corner(t));
      fans.join(next_corner(h), same_way ? next_corner(t) : t);
    }
    fan_of_.resize(at(3 * mesh_.face_count()));
    for (Index c = 0; c < 3 * mesh_.face_count(); ++c) fan_of_[at(c)] = fans.root(c);
  }

  Index place_of_corner(Index c) const { return place_[at(mesh_.face(c / 3)[at(c % 3)])]; }

  // Neighbours are told by their vertices alone: where an edge between the same two fans has other
  // half-edges than one pair, the first pair stays, the others are opened, and faces that still
  // stand there are cut out. True where something was; each time there are fewer pairs.
  bool separate(const PlaceEdges& edges) {
    bool any = false;
    loosened_.assign(fan_of_.size(), false);
    loose_at_.clear();
    std::vector<std::pair<std::pair<Index, Index>, Index>> keyed;
    for (std::size_t e = 0; e < edges.count(); ++e) {
      if (edges.edge(e).size() <= 2 && all_paired(edges.edge(e))) continue;
      keyed.clear();
      for (const Index h : edges.edge(e))
        keyed.push_back({std::minmax({fan_of_[at(h)], fan_of_[at(next_corner(h))]}), h});
      std::sort(keyed.begin(), keyed.end());
      for (std::size_t i = 0; i < keyed.size();) {
        std::size_t end = i + 1;
        while (end < keyed.size() && keyed[end].first == keyed[i].first) ++end;
        if (end - i > 1) any |= separate_one(edges, {keyed.data() + i, end - i});
        i = end;
      }
    }
    for (Index h = 0; h < 3 * mesh_.face_count(); ++h)
      if (loosened_[at(fan_of_[at(h)])] || loosened_[at(fan_of_[at(next_corner(h))])])
        if (is_loose(edges, h)) any |= open(h);
    return any;
  }

  // A pair that was made by place, or that folds a sheet onto itself.
  bool is_loose(const PlaceEdges& edges, Index h) const {
    const Index t = twins_[at(h)];
    if (t < 0) return false;
    const auto ends = [&](Index i) { return std::minmax({edges.tail(i), edges.head(i)}); };
    return ends(h) != ends(t) || is_fold(mesh_, turned_, h, t);
  }
  // Of the pairs that this round begins with.
  bool has_loose_pair(const PlaceEdges& edges, Index fan) {
    if (loose_at_.empty()) {
      loose_at_.assign(fan_of_.size(), false);
      for (Index h = 0; h < 3 * mesh_.face_count(); ++h)
        if (is_loose(edges, h))
          loose_at_[at(fan_of_[at(h)])] = loose_at_[at(fan_of_[at(next_corner(h))])] = true;
    }
    return loose_at_[at(fan)];
  }

  bool all_paired(std::span<const Index> edge) const {
    return std::all_of(edge.begin(), edge.end(), [this](Index h) { return twins_[at(h)] >= 0; });
  }

  bool separate_one(const PlaceEdges& edges,
                    std::span<const std::pair<std::pair<Index, Index>, Index>> sides) {
    if (sides.size() == 2) {
      const Index a = sides[0].second, b = sides[1].second;
      if (twins_[at(a)] == b) return false;
      if (twins_[at(a)] == kNone && twins_[at(b)] == kNone &&
          runs_up(edges, a) != runs_up(edges, b))
        return false;  // nothing else is there: they will close the surface
    }
    // Two pairs that run between the same two fans: what joined the fans is undone.
    std::size_t paired = 0;
    for (const auto& [fans, h] : sides) paired += twins_[at(h)] >= 0;
    if (paired >= 4) {
      const auto& [low, high] = sides.front().first;
      for (const Index fan : {low, high})
        if (has_loose_pair(edges, fan)) {
          loosened_[at(fan)] = true;
          return false;  // opened below
        }
    }
    Index kept = kNone;
    for (const auto& [fans, h] : sides)
      if (kept == kNone && twins_[at(h)] >= 0) kept = h;
    bool any = false;
    for (const auto& [fans, h] : sides) {
      if (h == kept || (kept != kNone && h == twins_[at(kept)])) continue;
      if (twins_[at(h)] >= 0)
        any |= open(h);
      else
        for (Index k = 0; k < 3; ++k) any |= open(3 * (h / 3) + k);
    }
    return any;
  }

  bool open(Index h) {
    const Index t = twins_[at(h)];
    if (t < 0) return false;
    twins_[at(h)] = twins_[at(t)] = kNone;
    return true;
  }

  void count_edges(const PlaceEdges& edges) {
    EdgeNote split, joined, one_sided;
    for (std::size_t e = 0; e < edges.count(); ++e) {
      const std::span<const Index> edge = edges.edge(e);
      bool is_open = false, is_joined = false;
      for (const Index h : edge) {
        const Index t = twins_[at(h)];
        is_open = is_open || t < 0;
        is_joined = is_joined || (t > h && std::minmax({edges.tail(h), edges.head(h)}) !=
                                               std::minmax({edges.tail(t), edges.head(t)}));
      }
      const Index lowest = *std::min_element(edge.begin(), edge.end());
      if (is_joined) joined(lowest);
      if (edge.size() == 2 && is_open && runs_up(edges, edge[0]) == runs_up(edges, edge[1]))
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
    for (const Index h : edge) ends.push_back(std::minmax({edges.tail(h), edges.head(h)}));
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
      if (left_out_[at(c / 3)]) continue;
      Index& v = lowest[at(fan_of_[at(c)])];
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
      if (left_out_[at(f)]) continue;
      for (Index k = 0; k < 3; ++k) {
        const Index v = own(3 * f + k), s = number[at(fan_of_[at(3 * f + k)])];
        faces[at(f)][at(k)] = s;
        Index& known = source->surface_vertex[at(v)];
        known = known == kNone ? s : std::min(known, s);
      }
      if (turned_[at(f)]) std::swap(faces[at(f)][1], faces[at(f)][2]);
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
      if (!left_out_[at(f)]) continue;
      const Index s = source->surface_vertex[at(mesh_.face(f)[0])];
      faces[at(f)].fill(s == kNone ? 0 : s);
    }
    count_vertices(*source, number);

    std::vector<Index> polygons;
    if (mesh_.has_polygons())
      for (Index f = 0; f < mesh_.face_count(); ++f) polygons.push_back(mesh_.polygon(f));
    source->faces.assign(mesh_.faces().begin(), mesh_.faces().end());
    source->turned = turned_;
    result.report = report_;
    result.mesh = TriangleMesh(std::move(positions), std::move(faces), std::move(polygons));
    result.mesh.set_source(std::move(source));
    result.half_edges = HalfEdges(result.mesh);
    return result;
  }

  void count_vertices(const MeshSource& source, const std::vector<Index>& number) {
    // Pairs (the caller's vertex, the surface's), each once.
    std::vector<std::pair<Index, Index>> uses;
    for (Index c = 0; c < 3 * mesh_.face_count(); ++c)
      if (!left_out_[at(c / 3)])
        uses.emplace_back(mesh_.face(c / 3)[at(c % 3)], number[at(fan_of_[at(c)])]);
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

  const TriangleMesh& mesh_;
  std::vector<Index> place_;
  std::vector<bool> left_out_, turned_;
  std::vector<Index> part_;                // #F: the faces that edges of two join, by their lowest
  std::vector<Index> twins_;               // #H
  std::vector<Index> fan_of_;              // #H: the lowest corner of each corner's fan
  std::vector<bool> loosened_, loose_at_;  // #H, for a round of `separate`: fans by their root
  ConnectReport report_;
};

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
    Connected made = Connector(mesh, std::move(place)).run();
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
