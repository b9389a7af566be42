#pragma once

#include <array>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include <mimicry/base/types.h>
#include <mimicry/mesh/attributes.h>

namespace mimicry {

/// A point on a triangle mesh: a face and barycentric coordinates of its three corners, in the
/// face's corner order; they are >= 0 and sum to 1. Every module speaks of points on the surface in
/// this one way.
struct SurfacePoint {
  Index face = kNone;
  Vec3 bary = Vec3::Zero();
};

using Face = std::array<Index, 3>;

/// Such a face has no area and no neighbours: it keeps its number and is no part of the surface.
constexpr bool repeats_corner(const Face& f) {
  return f[0] == f[1] || f[1] == f[2] || f[2] == f[0];
}

struct MeshSource;

/// A triangle mesh as flat arrays; immutable once it is made. It says nothing of topology
/// (`HalfEdges`) nor of quality (`validate`), so that any file's content can be held and reported.
class TriangleMesh {
 public:
  TriangleMesh() = default;

  /// positions: #V by 3, any unit. faces: #F by 3, 0-based, counter-clockwise seen from outside.
  /// polygons: empty, or #F numbers that do not decrease: the source polygon of each triangle
  /// (files may hold polygons; they are cut into triangles in file order). Throws
  /// Error(invalid_input) where a face refers to a vertex that does not exist, or `polygons` has
  /// another length than `faces`. O(#V + #F).
  TriangleMesh(std::vector<Vec3> positions, std::vector<Face> faces,
               std::vector<Index> polygons = {});

  Index vertex_count() const { return static_cast<Index>(positions_.size()); }
  Index face_count() const { return static_cast<Index>(faces_.size()); }
  std::span<const Vec3> positions() const { return positions_; }
  std::span<const Face> faces() const { return faces_; }
  const Vec3& position(Index vertex) const { return positions_[static_cast<std::size_t>(vertex)]; }
  const Face& face(Index f) const { return faces_[static_cast<std::size_t>(f)]; }
  /// Position of corner k (0, 1, 2) of a face.
  const Vec3& corner(Index f, int k) const {
    return position(face(f)[static_cast<std::size_t>(k)]);
  }
  /// Number of the polygon of the source file that triangle f was cut from; f itself where the
  /// source held triangles only.
  Index polygon(Index f) const {
    return polygons_.empty() ? f : polygons_[static_cast<std::size_t>(f)];
  }

  /// What `connect` made this surface of; null where vertices and faces are the caller's own.
  const MeshSource* source() const { return source_.get(); }
  void set_source(std::shared_ptr<const MeshSource> source) { source_ = std::move(source); }
  /// `connect` made it, or found it sound, and leaves it as it is: what lies at one place and was
  /// kept apart is not joined by a second look.
  bool is_connected() const { return is_connected_; }
  void mark_connected() { is_connected_ = true; }

  /// Texture coordinates, colours and labels of faces; null where it carries none. Copies of the
  /// mesh share them.
  const std::shared_ptr<const MeshAttributes>& attributes() const { return attributes_; }
  /// Empty ones are taken for none. Throws Error(invalid_input) where they do not fit the faces.
  /// O(#F).
  void set_attributes(std::shared_ptr<const MeshAttributes> attributes);

  /// The source held other polygons than triangles.
  bool has_polygons() const { return !polygons_.empty(); }

  Vec3 position(const SurfacePoint& p) const {
    return p.bary[0] * corner(p.face, 0) + p.bary[1] * corner(p.face, 1) +
           p.bary[2] * corner(p.face, 2);
  }
  /// Twice the area times the unit normal.
  Vec3 area_vector(Index f) const {
    return (corner(f, 1) - corner(f, 0)).cross(corner(f, 2) - corner(f, 0));
  }

  /// The same faces with other positions. Throws where the count differs.
  TriangleMesh with_positions(std::vector<Vec3> positions) const;
  /// Writes new positions in place; for the owner of a target that deforms.
  void set_positions(std::span<const Vec3> positions);

  /// Heap memory held, that of the attributes included.
  std::size_t memory_bytes() const {
    return positions_.capacity() * sizeof(Vec3) + faces_.capacity() * sizeof(Face) +
           polygons_.capacity() * sizeof(Index) + (attributes_ ? attributes_->memory_bytes() : 0);
  }

 private:
  std::vector<Vec3> positions_;
  std::vector<Face> faces_;
  std::vector<Index> polygons_;
  std::shared_ptr<const MeshSource> source_;
  std::shared_ptr<const MeshAttributes> attributes_;
  bool is_connected_ = false;
};

/// Smallest box with the vertices that faces use; empty (min > max) without any. Vertices that are
/// not finite are passed over. O(#V + #F).
Eigen::AlignedBox3d bounding_box(const TriangleMesh& mesh);

/// Length of the bounding box's diagonal, the size that relative tolerances refer to; 0 without
/// faces.
double diagonal(const TriangleMesh& mesh);

}  // namespace mimicry
