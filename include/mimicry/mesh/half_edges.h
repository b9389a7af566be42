#pragma once

#include <span>
#include <vector>

#include <mimicry/base/types.h>
#include <mimicry/mesh/triangle_mesh.h>

namespace mimicry {

/// Who lies beside whom. Half-edge h = 3 f + k runs in face f from corner k to corner (k + 1) % 3.
/// Next and previous are arithmetic, so that only twins and one half-edge per vertex are stored.
/// Immutable; depends on the faces alone, not on positions.
class HalfEdges {
 public:
  HalfEdges() = default;
  /// O(#F log #F). Never throws on odd topology: an edge with three or more faces, or with two
  /// faces that run along it in the same direction, gets no twins and counts as non-manifold. A
  /// face that names a vertex twice has no twins and counts nowhere.
  explicit HalfEdges(const TriangleMesh& mesh);

  static constexpr Index kNonManifold = -2;

  static Index face(Index h) { return h / 3; }
  static int corner(Index h) { return static_cast<int>(h % 3); }
  static Index next(Index h) { return h % 3 == 2 ? h - 2 : h + 1; }
  static Index previous(Index h) { return h % 3 == 0 ? h + 2 : h - 1; }

  Index count() const { return static_cast<Index>(twins_.size()); }
  /// The half-edge on the other side; kNone on the boundary, kNonManifold on a non-manifold edge.
  Index twin(Index h) const { return twins_[static_cast<std::size_t>(h)]; }
  bool has_twin(Index h) const { return twin(h) >= 0; }
  /// The vertex that h leaves from, and the one that it runs to.
  Index tail(Index h) const { return tails_[static_cast<std::size_t>(h)]; }
  Index head(Index h) const { return tail(next(h)); }
  /// Of h and its twin the smaller number: one name per edge.
  Index edge(Index h) const { return has_twin(h) && twin(h) < h ? twin(h) : h; }

  /// A half-edge that leaves vertex v, kNone for an isolated vertex. At a boundary vertex it is the
  /// one from which turning counter-clockwise (`ccw`) passes all faces of the fan.
  Index outgoing(Index v) const { return outgoing_[static_cast<std::size_t>(v)]; }
  /// The next half-edge that leaves the same vertex, counter-clockwise; negative past a boundary.
  Index ccw(Index h) const { return twin(previous(h)); }
  /// The same clockwise.
  Index cw(Index h) const { return has_twin(h) ? next(twin(h)) : kNone; }

  /// The vertex lies on a boundary or non-manifold edge, or is isolated.
  bool is_boundary_vertex(Index v) const {
    const Index h = outgoing(v);
    return h < 0 || !has_twin(h);
  }
  /// The faces around v do not form one fan (two cones that touch in a tip, say).
  bool is_nonmanifold_vertex(Index v) const { return nonmanifold_[static_cast<std::size_t>(v)]; }
  bool is_manifold() const { return manifold_; }

  /// Heap memory held.
  std::size_t memory_bytes() const {
    return (twins_.capacity() + tails_.capacity() + outgoing_.capacity()) * sizeof(Index) +
           nonmanifold_.capacity() / 8;
  }

 private:
  std::vector<Index> twins_;       // #H
  std::vector<Index> tails_;       // #H, the faces' corners
  std::vector<Index> outgoing_;    // #V
  std::vector<bool> nonmanifold_;  // #V
  bool manifold_ = true;
};

/// Where a path on the surface meets an edge: (1 - t) tail + t head of the half-edge, 0 <= t <= 1.
/// A path that passes through a vertex names a half-edge that leaves it, with t = 0 exactly.
struct Crossing {
  Index half_edge = kNone;
  double t = 0.0;
};

inline Vec3 position(const TriangleMesh& mesh, const Crossing& c) {
  const Index f = HalfEdges::face(c.half_edge);
  const int k = HalfEdges::corner(c.half_edge);
  return (1.0 - c.t) * mesh.corner(f, k) + c.t * mesh.corner(f, (k + 1) % 3);
}

/// The crossing as a point of the half-edge's own face.
inline SurfacePoint surface_point(const Crossing& c) {
  SurfacePoint p{HalfEdges::face(c.half_edge), Vec3::Zero()};
  const int k = HalfEdges::corner(c.half_edge);
  p.bary[k] = 1.0 - c.t;
  p.bary[(k + 1) % 3] = c.t;
  return p;
}

}  // namespace mimicry
