#pragma once

#include <memory>
#include <span>
#include <vector>

#include <mimicry/mesh/connect.h>
#include <mimicry/mesh/half_edges.h>
#include <mimicry/mesh/triangle_mesh.h>

namespace mimicry {

/// Unit normal of a face; zero for a face without area.
Vec3 face_normal(const TriangleMesh& mesh, Index f);

/// Unit vertex normals, face normals weighted by the face's angle at the vertex (Thuermer and
/// Wuethrich 1998): independent of how the faces are cut. #V by 3; zero at isolated vertices and
/// where the weighted sum vanishes. O(#V + #F).
std::vector<Vec3> angle_weighted_normals(const TriangleMesh& mesh);
/// The same into an array of #V that is already there; no allocation.
void angle_weighted_normals(const TriangleMesh& mesh, std::span<Vec3> normals);

/// Unit normal at a surface point: vertex normals interpolated, the face's own normal where they
/// cancel.
Vec3 interpolated_normal(const TriangleMesh& mesh, std::span<const Vec3> vertex_normals,
                         const SurfacePoint& p);

/// A mesh with what it takes to walk on it: who lies beside whom, and vertex normals. A handle:
/// copies are cheap and share one surface, which lives as long as any of them. Immutable, but for
/// the surface of a target that deforms (`Target::update_positions`); safe to read from many
/// threads.
class Surface {
 public:
  /// Holds nothing; it may only be assigned to, and asked whether it holds something.
  Surface() = default;
  /// The surface that `connect` makes of a mesh of any kind. Never throws but for memory.
  /// O(#F log #F).
  explicit Surface(TriangleMesh mesh, const ConnectOptions& options = {});
  /// The mesh as it is, without `connect`: paths and curves end where its half-edges have no twins.
  static Surface as_given(TriangleMesh mesh);

  explicit operator bool() const { return data_ != nullptr; }

  /// Positions and face numbers are those of the mesh given; `mesh().source()` maps its vertices.
  const TriangleMesh& mesh() const { return data_->mesh; }
  const HalfEdges& half_edges() const { return data_->half_edges; }
  /// #V unit normals, weighted by angle; zero where the sum vanishes, and
  /// everywhere where a vertex of the mesh is not finite.
  std::span<const Vec3> vertex_normals() const { return data_->normals; }
  /// What was joined, split, turned and left out to make it.
  const ConnectReport& connection() const { return data_->connection; }

  Vec3 position(const SurfacePoint& p) const { return data_->mesh.position(p); }
  /// Unit normal, interpolated between the vertices.
  Vec3 normal(const SurfacePoint& p) const {
    return interpolated_normal(data_->mesh, data_->normals, p);
  }

  /// Heap memory held, by all copies together.
  std::size_t memory_bytes() const;

 private:
  friend class Target;

  struct Data {
    TriangleMesh mesh;
    HalfEdges half_edges;
    std::vector<Vec3> normals;  // #V
    ConnectReport connection;
  };

  std::shared_ptr<Data> data_;
};

}  // namespace mimicry
