#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <mimicry/mesh/surface.h>

namespace mimicry {

/// The tangent plane at the centre, and where each vertex of the patch lies in it.
struct ExponentialPatch {
  Vec3 origin = Vec3::Zero();
  Vec3 x_axis = Vec3::Zero();  ///< unit, orthogonal to each other and to the normal
  Vec3 y_axis = Vec3::Zero();
  Vec3 normal = Vec3::Zero();
  std::vector<Index> vertices;    ///< nearest first
  std::vector<Vec2> coordinates;  ///< of each of them: length is distance, model units
};

/// The discrete exponential map, fast and approximate: vertices are settled in the order of their
/// distance, each from its settled neighbours (upwind; Schmidt, Grimm and Wyvill 2006). Where a
/// face has two settled vertices the centre is unfolded from their distances and its direction
/// divided as the angle there (Melvaer and Reimers 2012), which unlike sums of edges converges on
/// curved surfaces; elsewhere a vertex takes the mean, weighted by nearness, of its neighbours'
/// coordinates plus the edges laid in their tangent planes with their lengths kept (Schmidt 2013),
/// planes turned into each other step by step along the way. Exact on planes. Beyond the points
/// that several ways reach (the cut locus) coordinates tear. On any mesh, however bad its faces,
/// lengths are at least those of the straight lines and at most those of the shortest ways along
/// edges (that begin with a straight line to a corner of the centre's face), but for rounding: what
/// leaves these bounds keeps its direction.
class DiscreteExponentialMap {
 public:
  explicit DiscreteExponentialMap(const Surface& surface);

  /// All vertices that are connected to p within `radius` (model units, > 0; infinity: its
  /// component). `x_hint` gives the x axis by its part in the tangent plane; where it has none any
  /// axis is taken. Throws Error(invalid_input) for p off the mesh or a radius that is not
  /// positive. The result stays until the next call; no allocation after warm-up.
  /// O(patch log patch).
  const ExponentialPatch& compute(const SurfacePoint& p, double radius,
                                  const Vec3& x_hint = Vec3::Zero());

 private:
  struct Entry {
    double key;
    Index vertex;
    bool operator<(const Entry& other) const {
      return key != other.key ? key > other.key : vertex > other.vertex;
    }
  };
  enum State : std::uint8_t { reached, settled };

  template <class Visit>
  void for_each_neighbour(Index vertex, Visit&& visit) const;
  bool is_settled(Index v) const {
    const auto i = static_cast<std::size_t>(v);
    return stamps_[i] == stamp_ && states_[i] == settled;
  }
  bool unfold(Index h, Vec2& place) const;
  void settle(Index vertex);
  Vec2 no_shorter_than_straight(Index vertex) const;
  void reach(Index vertex, const Vec2& place, double key, double bound, Index from);
  void update(Index vertex, Index from);

  Surface surface_;  // keeps alive what the next three refer to
  const TriangleMesh& mesh_;
  const HalfEdges& half_edges_;
  std::span<const Vec3> normals_;
  ExponentialPatch patch_;
  std::vector<Entry> heap_;
  std::vector<std::uint32_t> stamps_;  // #V; the rest is valid where stamped
  std::uint32_t stamp_ = 0;
  std::vector<State> states_;
  std::vector<double> keys_;
  std::vector<Index> from_;     // the vertex that it was reached from, kNone: the centre
  std::vector<double> bounds_;  // of the length, by the edges from settled neighbours
  std::vector<Vec3> x_axes_;    // the centre's x axis, carried to the vertex
  std::vector<Vec2> places_;
};

}  // namespace mimicry
