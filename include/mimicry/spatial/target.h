#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <mimicry/mesh/surface.h>

namespace mimicry {

/// The point of a surface that is closest to a query.
struct ClosestPoint {
  SurfacePoint surface;
  Vec3 position;    ///< mesh units
  double distance;  ///< from the query, mesh units
};

struct RayHit {
  SurfacePoint surface;
  Vec3 position;    ///< mesh units, on the surface
  double distance;  ///< from the ray's origin along its direction, >= 0, mesh units
};

struct TargetOptions {
  bool join = true;     ///< vertices at equal positions at seams (ConnectOptions)
  bool strict = false;  ///< refuse what `connect` would mend, rather than mend it
};

/// A surface ready to be drawn on: the `Surface` of a mesh and a hierarchy of its faces. Meshes
/// with boundary and with several components are welcome. A handle: copies are cheap and share one
/// target, which lives as long as any of them. Queries are const, safe from many threads, allocate
/// nothing (but `all_hits`, when its vector must grow), and give the same bits every time; equal
/// distances go to the lower face number.
///
/// A face without area (height below 1e-14 of its longest side) is never the closest; a ray meets
/// it only where leaving it out would open a slit.
class Target {
 public:
  /// Holds nothing; it may only be assigned to, and asked whether it holds something.
  Target() = default;
  /// Throws Error(invalid_input), with the count and the first example, where the mesh has no
  /// faces, a vertex of a face that is not finite, a size or place outside 1e-30 .. 1e30, no face
  /// with area, or (where `strict`) a flaw that `connect` mends. O(#F log #F).
  explicit Target(TriangleMesh mesh, const TargetOptions& options = {});

  explicit operator bool() const { return state_ != nullptr; }

  const Surface& surface() const { return surface_; }
  /// The surface's: the caller's positions and face numbers; `mesh().source()` maps its vertices.
  const TriangleMesh& mesh() const { return surface_.mesh(); }
  const HalfEdges& half_edges() const { return surface_.half_edges(); }
  const ConnectReport& connection() const { return surface_.connection(); }
  /// #V unit normals, weighted by angle.
  std::span<const Vec3> vertex_normals() const { return surface_.vertex_normals(); }
  /// #V unit normals of which each sees all its faces from the front: a point just above the
  /// surface along them is outside.
  std::span<const Vec3> visible_normals() const;
  const Eigen::AlignedBox3d& bounding_box() const;
  /// Of the bounding box: the size that relative tolerances refer to.
  double diagonal() const;

  /// The closest point at a distance of at most upper_bound (>= 0); nullopt where there is none or
  /// y is not finite (or beyond 1e60). hint: a face that is probably near, such as the last answer;
  /// it saves time and never changes the answer. O(log #F) near the surface.
  std::optional<ClosestPoint> closest_point(const Vec3& y, double upper_bound = kInfinity,
                                            Index hint = kNone) const;

  /// The first point of the surface on the ray, from either side; nullopt where there is none,
  /// the direction is zero, or anything is not finite. direction: any length. No ray slips between
  /// two faces that share an edge or a vertex. O(log #F).
  std::optional<RayHit> first_hit(const Vec3& origin, const Vec3& direction) const;

  /// Appends every face that the ray hits, by distance, then face number: a hit on an edge or a
  /// vertex comes once for each of its faces.
  void all_hits(const Vec3& origin, const Vec3& direction, std::vector<RayHit>& hits) const;

  Vec3 position(const SurfacePoint& p) const { return surface_.position(p); }
  /// Unit normal, interpolated between the vertices.
  Vec3 normal(const SurfacePoint& p) const { return surface_.normal(p); }

  /// Moves the vertices (#V of the caller's mesh) of this target and all its copies: refits what it
  /// holds, allocates nothing. Nobody may read it meanwhile. Throws, and changes nothing, where the
  /// count differs or the constructor would refuse the positions. A bake is of one shape: bake
  /// anew what has moved. O(#F).
  void update_positions(std::span<const Vec3> positions);

  /// Heap memory held, by all copies together.
  std::size_t memory_bytes() const;

 private:
  struct State;

  Surface surface_;
  std::shared_ptr<State> state_;
};

}  // namespace mimicry
