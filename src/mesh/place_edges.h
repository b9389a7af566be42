#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include <mimicry/mesh/triangle_mesh.h>

namespace mimicry {

/// The half-edges of a mesh's faces, those between the same two places beside each other: an edge.
/// `place` (#V) tells which vertices count as one; the mesh and it must outlive this. Half-edge
/// 3 f + k runs from corner k of face f, in the order of the face's own corners.
class PlaceEdges {
 public:
  /// left_out: #F, faces that do not count. O(n log n) in the half-edges at one place.
  PlaceEdges(const TriangleMesh& mesh, const std::vector<Index>& place,
             const std::vector<bool>& left_out);

  std::size_t count() const { return runs_.size() - 1; }
  /// In the order of their numbers.
  std::span<const Index> edge(std::size_t i) const {
    return {half_edges_.data() + runs_[i], runs_[i + 1] - runs_[i]};
  }
  Index tail(Index h) const { return mesh_.face(h / 3)[at(h % 3)]; }
  Index head(Index h) const { return mesh_.face(h / 3)[at((h + 1) % 3)]; }
  /// The two vertices, by number, the lower first.
  std::pair<Index, Index> ends(Index h) const { return std::minmax({tail(h), head(h)}); }
  /// Whether it runs from the lower place to the higher.
  bool runs_up(Index h, const std::vector<bool>& turned) const {
    return (place_[at(tail(h))] < place_[at(head(h))]) != turned[at(h / 3)];
  }

  /// Visits the runs of an edge's half-edges that share both vertices by number, lowest first.
  /// sorted: memory to work in.
  template <class Visit>
  void by_number(std::span<const Index> edge, std::vector<Index>& sorted, Visit&& visit) const {
    sorted.assign(edge.begin(), edge.end());
    std::sort(sorted.begin(), sorted.end(),
              [&](Index a, Index b) { return std::tuple(ends(a), a) < std::tuple(ends(b), b); });
    for (std::size_t i = 0; i < sorted.size();) {
      std::size_t end = i + 1;
      while (end < sorted.size() && ends(sorted[end]) == ends(sorted[i])) ++end;
      visit(std::span<const Index>(sorted.data() + i, end - i));
      i = end;
    }
  }

 private:
  const TriangleMesh& mesh_;
  const std::vector<Index>& place_;
  std::vector<Index> half_edges_;
  std::vector<std::size_t> runs_;
};

}  // namespace mimicry
