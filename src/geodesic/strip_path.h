#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <mimicry/mesh/half_edges.h>
#include <mimicry/mesh/triangle_mesh.h>

namespace mimicry {

/// Locally shortest paths: a strip of faces from one point to the other, the shortest path in it by
/// the funnel algorithm (Lee and Preparata 1984), and the strip moved to the other side of every
/// vertex where the path could then be shorter.
class StripPath {
 public:
  StripPath(const TriangleMesh& mesh, const HalfEdges& half_edges);

  /// False where no strip of faces joins the points. `from` and `to` do not share a face.
  bool run(const SurfacePoint& from, const SurfacePoint& to);
  double length() const { return length_; }
  void append_crossings(std::vector<Crossing>& crossings) const;

 private:
  struct Bend {
    std::size_t portal;  ///< the path meets the vertex at an end of this crossed edge
    bool at_head;
    Vec2 at;
  };

  bool find_strip(const SurfacePoint& from, const SurfacePoint& to);
  void pull_tight(const SurfacePoint& from, const SurfacePoint& to);
  std::pair<Vec2, Vec2> unfold(const SurfacePoint& from, const SurfacePoint& to);
  void find_bends(const Vec2& start, const Vec2& end);
  void cross_edges(const Vec2& start, const Vec2& end);
  bool move_around_a_vertex(const SurfacePoint& from, const SurfacePoint& to);
  double corner_angle(Index h) const;

  const TriangleMesh& mesh_;
  const HalfEdges& half_edges_;
  std::vector<double> costs_;          // #F, valid where stamped
  std::vector<Index> entered_;         // #F, the half-edge that a face was entered over
  std::vector<std::uint32_t> stamps_;  // #F
  std::uint32_t stamp_ = 0;
  struct Entry {
    double key;
    double cost;
    Index face;
    bool operator<(const Entry& other) const {
      return key != other.key ? key > other.key : face > other.face;
    }
  };
  std::vector<Entry> heap_;
  std::vector<Index> strip_;  // half-edges crossed, each in the face that is left
  std::vector<Vec2> heads_;   // the unfolded strip: ends of the crossed edges
  std::vector<Vec2> tails_;
  std::vector<Bend> bends_;     // of the tight path, in order
  std::vector<double> params_;  // along each crossed edge
  std::vector<Index> other_way_;
  double length_ = kInfinity;
};

}  // namespace mimicry
