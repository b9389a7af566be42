#include "mesh/kept_faces.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <tuple>
#include <utility>

#include "mesh/findings.h"
#include "mesh/place_edges.h"
#include "mesh/sets.h"

namespace mimicry {
namespace {

class Keeper {
 public:
  Keeper(const TriangleMesh& mesh, const std::vector<Index>& place, ConnectReport& report)
      : mesh_(mesh), place_(place), report_(report) {
    faces_.left_out.assign(at(mesh.face_count()), false);
    faces_.turned.assign(at(mesh.face_count()), false);
    faces_.part.assign(at(mesh.face_count()), kNone);
    has_back_.assign(at(mesh.face_count()), false);
  }

  KeptFaces run() {
    leave_out_collapsed_faces();
    leave_out_doubles_and_turn();
    return std::move(faces_);
  }

 private:
  // Where doubles are gone, or faces were turned, others may no longer wall anything off.
  void leave_out_doubles_and_turn() {
    constexpr int kMostRounds = 16;
    bool any = true;
    for (int round = 0; round < kMostRounds && any; ++round) {
      any = turn_faces(PlaceEdges(mesh_, place_, faces_.left_out));
      any |= leave_out_doubles();
    }
    turn_two_sided_parts();
    for (Index f = 0; f < mesh_.face_count(); ++f)
      if (faces_.turned[at(f)]) note(report_.turned_faces, f);
  }

  void leave_out_collapsed_faces() {
    for (Index f = 0; f < mesh_.face_count(); ++f)
      if (repeats_corner(places_of(f))) {
        faces_.left_out[at(f)] = true;
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
    for (const Index h : edge) up += edges.runs_up(h, faces_.turned) ? 1 : -1;
    return up == 0;
  }

  // The places of a polygon's corners, sorted; empty where a face of it is left out.
  std::vector<Index> outline(Index first, Index end) const {
    std::vector<Index> places;
    for (Index f = first; f < end; ++f) {
      if (faces_.left_out[at(f)]) return {};
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
    const PlaceEdges edges(mesh_, place_, faces_.left_out);
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
      faces_.left_out[at(f)] = any = true;
      if (found.count++ > 0 && f > found.first) continue;
      found.first = f;
      found.first_copy_of = copy_of[at(f)];
    }
    note_backs(copy_of);
    return any;
  }

  // All faces of the polygon with this one, its first.
  template <class Visit>
  void each_face_of_polygon(Index first, Visit&& visit) const {
    for (Index f = first; f < mesh_.face_count() && mesh_.polygon(f) == mesh_.polygon(first); ++f)
      visit(f);
  }

  // Of which polygons the file has both sides.
  void note_backs(const std::vector<Index>& copy_of) {
    const auto area = [&](Index first) {
      Vec3 sum = Vec3::Zero();
      each_face_of_polygon(first, [&](Index f) { sum += mesh_.area_vector(f); });
      return sum;
    };
    for (Index f = 0; f < mesh_.face_count(); ++f) {
      if (copy_of[at(f)] == kNone || !faces_.left_out[at(f)]) continue;
      if (f > 0 && mesh_.polygon(f - 1) == mesh_.polygon(f)) continue;
      if (area(f).dot(area(copy_of[at(f)])) > 0.0) continue;
      each_face_of_polygon(copy_of[at(f)], [&](Index g) { has_back_[at(g)] = true; });
    }
  }

  // Which side of a closed part comes first in the file says nothing where it has both of all
  // faces: the part is turned to enclose a positive volume.
  void turn_two_sided_parts() {
    if (std::find(has_back_.begin(), has_back_.end(), true) == has_back_.end()) return;
    struct Part {
      bool is_two_sided = true, is_closed = true;
      double volume = 0.0, sum = 0.0;  // six times; of absolute values
    };
    std::vector<Part> all(at(mesh_.face_count()));
    const auto part = [&](Index f) -> Part& { return all[at(faces_.part[at(f)])]; };
    const PlaceEdges edges(mesh_, place_, faces_.left_out);
    for (std::size_t e = 0; e < edges.count(); ++e)
      if (!is_balanced(edges, edges.edge(e)))
        for (const Index h : edges.edge(e)) part(h / 3).is_closed = false;
    for (Index f = 0; f < mesh_.face_count(); ++f) {
      if (faces_.left_out[at(f)]) continue;
      Part& p = part(f);
      p.is_two_sided = p.is_two_sided && has_back_[at(f)];
      const double volume = volume_below(f, faces_.part[at(f)]);
      p.volume += volume;
      p.sum += std::abs(volume);
    }
    constexpr double kRounding = 1e-12;
    for (Index f = 0; f < mesh_.face_count(); ++f) {
      const Part& p = part(f);
      if (faces_.left_out[at(f)] || !p.is_two_sided || !p.is_closed) continue;
      if (p.volume < -kRounding * p.sum) faces_.turned[at(f)] = !faces_.turned[at(f)];
    }
  }

  // Six times the volume of a tetrahedron, seen from the first corner of a part's first face.
  double volume_below(Index f, Index part) const {
    const Vec3& origin = mesh_.corner(part, 0);
    const Vec3 b = mesh_.corner(f, 1) - origin, c = mesh_.corner(f, 2) - origin;
    const double volume = (mesh_.corner(f, 0) - origin).dot(b.cross(c));
    return faces_.turned[at(f)] ? -volume : volume;
  }

  // Edges of two faces, by number and then by place, tell whether these agree; a part is what they
  // join. False where all do.
  bool turn_faces(const PlaceEdges& edges) {
    Sets parts(mesh_.face_count());
    std::vector<Index> against;   // a face of each edge whose faces run against each other
    std::vector<Index> contrary;  // the same where turning faces would not mend it
    std::vector<Index> open;      // faces with an edge that joins no two
    const auto join = [&](Index a, Index b) {
      const bool against_each_other =
          edges.runs_up(a, faces_.turned) == edges.runs_up(b, faces_.turned);
      if (against_each_other) against.push_back(a / 3);
      if (!parts.join(a / 3, b / 3, against_each_other)) contrary.push_back(a / 3);
    };
    std::vector<Index> sorted;
    for (std::size_t e = 0; e < edges.count(); ++e)
      edges.by_number(edges.edge(e), sorted, [&](std::span<const Index> run) {
        if (run.size() == 2) join(run[0], run[1]);
      });
    for (std::size_t e = 0; e < edges.count(); ++e) {
      const std::span<const Index> edge = edges.edge(e);
      edges.by_number(edge, sorted, [&](std::span<const Index> run) {
        if (run.size() == 2) return;
        if (edge.size() == 2 && run[0] == edge[0]) join(edge[0], edge[1]);
        if (edge.size() != 2)
          for (const Index h : run) open.push_back(h / 3);
      });
    }
    for (Index f = 0; f < mesh_.face_count(); ++f) faces_.part[at(f)] = parts.root(f);
    if (against.empty()) return false;
    struct Part {
      bool closed = true;
      Index against = 0, contrary = 0, as_root = 0, against_root = 0;
      double volume = 0.0;  // six times, with all faces as the root's
    };
    std::vector<Part> all(at(mesh_.face_count()));
    const auto part = [&](Index f) -> Part& { return all[at(faces_.part[at(f)])]; };
    for (const Index f : against) ++part(f).against;
    for (const Index f : contrary) ++part(f).contrary;
    for (const Index f : open) part(f).closed = false;
    for (Index f = 0; f < mesh_.face_count(); ++f) {
      if (faces_.left_out[at(f)] || part(f).against == 0) continue;
      const Sets::Root root = parts.find(f);
      ++(root.odd ? part(f).against_root : part(f).as_root);
      part(f).volume += (root.odd ? -1.0 : 1.0) * volume_below(f, root.root);
    }
    bool any = false;
    for (Index f = 0; f < mesh_.face_count(); ++f) {
      const Part& p = part(f);
      // Of a one-sided part only what gets better by it.
      if (faces_.left_out[at(f)] || p.against <= p.contrary) continue;
      const bool closed = p.closed && p.contrary == 0 && p.volume != 0.0;
      const bool root_turns = closed ? p.volume < 0.0 : p.against_root > p.as_root;
      if (parts.find(f).odd == root_turns) continue;
      faces_.turned[at(f)] = !faces_.turned[at(f)];
      any = true;
    }
    return any;
  }

  const TriangleMesh& mesh_;
  const std::vector<Index>& place_;
  KeptFaces faces_;
  std::vector<bool> has_back_;  // #F, where a double of the other side is left out
  ConnectReport& report_;
};

}  // namespace

KeptFaces keep_faces(const TriangleMesh& mesh, const std::vector<Index>& place,
                     ConnectReport& report) {
  return Keeper(mesh, place, report).run();
}

}  // namespace mimicry
