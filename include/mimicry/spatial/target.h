#pragma once

#include <optional>
#include <span>
#include <vector>

#include <mimicry/mesh/connect.h>
#include <mimicry/mesh/half_edges.h>
#include <mimicry/mesh/normals.h>
#include <mimicry/mesh/triangle_mesh.h>
#include <mimicry/mesh/visible_normals.h>
#include <mimicry/spatial/bvh.h>
#include <mimicry/spatial/triangle.h>

namespace mimicry::spatial {

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

/// A mesh ready to be drawn on: the surface that `connect` makes of it, neighbours, vertex normals,
/// hierarchy. Meshes with boundary and with several components are welcome. Queries are const, safe
/// from many threads, allocate nothing (but `all_hits`, when its vector must grow), and give the
/// same bits every time; equal distances go to the lower face number.
///
/// A face without area (height below 1e-14 of its longest side) is never the closest; a ray meets
/// it only where leaving it out would open a slit.
class Target {
 public:
  /// Throws Error(invalid_input), with the count and the first example, where the mesh has no
  /// faces, a vertex of a face that is not finite, a size or place outside 1e-30 .. 1e30, no face
  /// with area, or (where `strict`) a flaw that `connect` mends. O(#F log #F).
  explicit Target(TriangleMesh mesh, const TargetOptions& options = {});

  /// The surface: the caller's positions and face numbers; `mesh().source()` maps its vertices.
  const TriangleMesh& mesh() const { return mesh_; }
  /// What was joined, split, turned and left out to make it.
  const ConnectReport& connection() const { return connection_; }
  const HalfEdges& half_edges() const { return half_edges_; }
  /// #V unit normals, weighted by angle.
  std::span<const Vec3> vertex_normals() const { return normals_; }
  /// #V unit normals of which each sees all its faces from the front (`make_visible`).
  std::span<const Vec3> visible_normals() const { return visible_normals_; }
  const Eigen::AlignedBox3d& bounding_box() const { return box_; }
  /// Of the bounding box: the size that relative tolerances refer to.
  double diagonal() const { return diagonal_; }

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

  Vec3 position(const SurfacePoint& p) const { return mesh_.position(p); }
  /// Unit normal, interpolated between the vertices.
  Vec3 normal(const SurfacePoint& p) const { return interpolated_normal(mesh_, normals_, p); }

  /// Moves the vertices (#V of the caller's mesh): refits the hierarchy, the normals and the boxes,
  /// allocates nothing. Throws, and changes nothing, where the count differs or the constructor
  /// would refuse the positions. O(#F).
  void update_positions(std::span<const Vec3> positions);

  /// Heap memory held.
  std::size_t memory_bytes() const;

 private:
  TriangleMesh mesh_;
  ConnectReport connection_;
  std::vector<Vec3> moved_;  // #V, room for update_positions; empty where vertices are the caller's
  HalfEdges half_edges_;
  std::vector<Vec3> normals_;
  std::vector<Vec3> visible_normals_;
  Bvh<3, Triangle> bvh_;
  Eigen::AlignedBox3d box_;
  double diagonal_ = 0.0;
};

}  // namespace mimicry::spatial
