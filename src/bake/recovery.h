#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <mimicry/base/parallel.h>

#include "bake/delaunay.h"
#include "bake/ls_mesh.h"
#include "bake/unit_mesh.h"

namespace mimicry {

/// Adds points on a surface to Delaunay tetrahedra that have its vertices first until its edges and
/// faces stand among them.
class Recovery {
 public:
  /// distances: of the other vertices of `delaunay` from the surface; positions: of all.
  Recovery(const UnitSurface& surface, Delaunay& delaunay, std::vector<Vec3>& positions,
           std::vector<double>& distances, double half_side, Executor& executor);

  /// One round; whether anything was added. Faces are looked at when no edge is missing.
  bool round();
  /// Counts what is missing now; edges alone where more than so many are.
  void count(double most_edges);

  const std::vector<Tie>& ties() const { return ties_; }
  Index missing_edges() const { return missing_edges_; }
  Index pierced_faces() const { return pierced_faces_; }
  Index crossing_faces() const { return crossing_faces_; }
  bool hit_shortest() const { return hit_shortest_; }

 private:
  // A piece of the surface's edge from corner a to corner b, between the parameters of its ends.
  struct Segment {
    Index u, v;
    Index a, b;
    double from, to;
    Index witness = kNone;  // a cell at which it was an edge when last looked for
  };
  struct Piercing {
    Index face;
    Vec3 bary;
    double spacing;  // length of the edge that pierces
  };
  // A cut of a segment at a parameter of its edge.
  struct Cut {
    std::size_t segment;
    double parameter;
  };

  void find_segments();
  std::vector<Cut> missing();
  bool find_piercings(std::vector<Piercing>& piercings, std::vector<Cut>& cuts);
  void find_flat_crossings(std::vector<Cut>& cuts);
  bool add(const std::vector<Cut>& cuts, const std::vector<Piercing>& piercings);
  bool lies_on(Index v, Index face) const;
  bool share_a_face(Index u, Index v) const;
  std::size_t segment_of(Index u, Index v) const;
  void sort_segments();

  const UnitSurface& surface_;
  const TriangleMesh& mesh_;
  Delaunay& delaunay_;
  std::vector<Vec3>& positions_;
  std::vector<double>& distances_;
  double half_side_;
  Executor& executor_;
  Index free_end_;                            // vertices at and after this one were added here
  std::vector<Index> first_face_, faces_at_;  // faces around each vertex
  std::vector<Segment> segments_;             // by edge, then along it
  std::vector<Tie> ties_;
  std::vector<std::pair<std::uint64_t, std::size_t>> by_ends_;
  std::uint32_t checked_ = 0;  // batches of tetrahedra whose edges are known not to pierce
  Index missing_edges_ = 0, pierced_faces_ = 0, crossing_faces_ = 0;
  std::vector<bool> crossing_;
  bool hit_shortest_ = false;
  bool left_out_ = false;  // something found in this round was not acted upon
};

}  // namespace mimicry
