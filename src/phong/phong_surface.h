#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include <mimicry/mesh/half_edges.h>
#include <mimicry/mesh/triangle_mesh.h>

#include "base/large_vector.h"
#include "phong/face_equation.h"
#include "phong/triangle8.h"
#include "spatial/bvh.h"

namespace mimicry {

struct PhongPoint {
  SurfacePoint surface;
  double distance;  ///< |y - x| in the embedding
};

/// Faces in the order in which a `PhongSurface` searches them fastest (`leaf_order`).
/// values: as there. Empty where the dimension is not from 1 to 8. O(#F log #F).
std::vector<Index> face_order(std::span<const Face> faces, std::span<const double> values,
                              int dimension);

/// A triangle mesh in R^8 with the continuous tangent field of Phong projection: x = sum b_i x_i
/// is the projection of y where T(b) (y - x) = 0 (Panozzo, Baran, Diamanti, Sorkine-Hornung,
/// Weighted Averages on Surfaces, 2013, section 4.2). Of all triangles with a solution the one with
/// the nearest x wins, then the lowest face. Immutable; queries are const, safe from many threads,
/// allocate nothing and give the same bits every time.
class PhongSurface {
 public:
  /// values: #V by dimension, by rows; finite, sizes between 1e-30 and 1e30. More rows than
  /// vertices are allowed and passed over. order: what `face_order` gives, which is called where it
  /// is empty; any other order costs speed only. Throws Error(unsupported) for a dimension above 8.
  /// O(#F), about 400 bytes a face.
  PhongSurface(const TriangleMesh& mesh, const HalfEdges& half_edges,
               std::span<const double> values, int dimension, std::span<const Index> order = {});

  /// nullopt where no triangle has a solution. y: finite, below 1e60. hint: a face that is probably
  /// near, such as the last answer; it saves time and never changes the answer.
  std::optional<PhongPoint> project(const Vec8& y, Index hint = kNone) const;
  /// The same by looking at every face: the definition.
  std::optional<PhongPoint> project_exhaustively(const Vec8& y) const;

  Index face_count() const { return static_cast<Index>(faces_.size()); }
  /// Length of the bounding box's diagonal in the embedding.
  double size() const { return size_; }
  Vec8 position(const SurfacePoint& p) const;
  /// T(b). At a corner, where T depends on the direction, one of its values.
  Basis tangent_plane(const SurfacePoint& p) const;
  /// The equation of y on one face.
  FaceEquation equation(Index face, const Vec8& y) const;

  /// Heap memory held.
  std::size_t memory_bytes() const;

 private:
  struct Record {
    Face corners;
    FaceFrames frames;
  };

  Triangle8 triangle(Index face) const {
    const Face& f = faces_[static_cast<std::size_t>(face)].corners;
    return {{&value(f[0]), &value(f[1]), &value(f[2])}};
  }
  double first_side(Index face) const;  // its length
  void consider(Index face, const Vec8& y, SurfacePoint& best, double& distance2) const;
  const Vec8& value(Index v) const { return values_[static_cast<std::size_t>(v)]; }

  std::vector<Vec8> values_;     // #V
  std::vector<Basis> tangents_;  // #V
  LargeVector<Record> faces_;    // #F
  Bvh<kDimension, Triangle8> bvh_;
  double size_ = 0.0;
};

}  // namespace mimicry
