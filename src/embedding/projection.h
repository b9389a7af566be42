#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include <mimicry/embedding/smooth_projector.h>

#include "phong/phong_surface.h"
#include "spatial/bvh.h"

namespace mimicry {

/// A place in the shell.
struct ShellPoint {
  Index tet = kNone;
  Eigen::Vector4d bary = Eigen::Vector4d::Zero();  ///< >= 0, sum 1
};

/// What a `SmoothProjector` shares with its copies: the shell's tetrahedra, the surface in R^8 and
/// the searches in both. See there.
class SmoothProjection {
 public:
  /// Throws Error(invalid_input) where the embedding is of another mesh or contradicts itself
  /// (sizes, vertex numbers, numbers that are not finite), Error(unsupported) above 8 dimensions.
  /// O(#T + #F log #F).
  SmoothProjection(Embedding embedding, const Target& target);
  SmoothProjection(const SmoothProjection&) = delete;
  SmoothProjection& operator=(const SmoothProjection&) = delete;

  /// SCP(y), in the mesh's frame and units; nullopt where y is not finite (or beyond 1e60). hint:
  /// where to start; left with where to start for a query nearby.
  std::optional<SmoothPoint> project(const Vec3& y, const ScpOptions& options = {},
                                     ScpHint* hint = nullptr) const;
  /// The same by the exhaustive Phong projection.
  std::optional<SmoothPoint> project_exhaustively(const Vec3& y,
                                                  const ScpOptions& options = {}) const;

  /// The point of the surface at the weighted sum of points in R^8 (Panozzo et al. 2013, 3).
  /// weights: as many as points, sum 1, negative ones allowed. Where nothing projects there, the
  /// closest point to the weighted sum in space (`no_phong_solution`). At least one point.
  SmoothPoint weighted_average(std::span<const SurfacePoint> points,
                               std::span<const double> weights, Index face_hint = kNone) const;

  /// y's tetrahedron; of several (on a common face) the one that it lies deepest in; of those of
  /// several parts of the surface that of the part with the closest point; then the lowest. Where
  /// it is too flat for coordinates, the nearest that is not, with y drawn into it. tet kNone
  /// outside the shell. y: finite, below 1e60.
  ShellPoint locate(const Vec3& y, const ScpHint& hint = {}) const;
  /// Its position in R^8.
  Vec8 lift(const ShellPoint& p) const;

  const Target& target() const { return target_; }
  const PhongSurface& surface() const { return surface_; }
  const Embedding& embedding() const { return embedding_; }
  std::size_t memory_bytes() const;

 private:
  struct Tetrahedron {
    using Pack = NoPack;  // the hierarchy holds numbers only

    const Vec3* positions;
    std::array<Index, 4> corners;

    const Vec3& corner(std::size_t k) const {
      return positions[static_cast<std::size_t>(corners[k])];
    }
    Eigen::AlignedBox3d box() const;
    // False where it is too flat for coordinates.
    bool barycentric(const Vec3& y, Eigen::Vector4d& bary) const;
    double nearest(const Vec3& y, Eigen::Vector4d& bary) const;
  };

  Tetrahedron tetrahedron(Index tet) const {
    return {embedding_.positions.data(), embedding_.tets[static_cast<std::size_t>(tet)]};
  }
  // Others may stand in the same place.
  bool overlaps(Index tet) const { return tet >= shell_.size() - embedding_.overlapping_tets; }
  ShellPoint of_nearest_part(const Vec3& y, std::span<const ShellPoint> places,
                             Index face_hint) const;
  template <class Project>
  SmoothPoint resolve(const Vec3& y, const ScpOptions& options, ScpHint& hint,
                      Project&& project) const;

  Embedding embedding_;
  Target target_;
  PhongSurface surface_;
  Bvh<3, Tetrahedron> shell_;
};

/// What a projector that is not empty works with, for tests and benchmarks.
inline const SmoothProjection& projection_of(const SmoothProjector& projector) {
  return *projector.projection_;
}

}  // namespace mimicry
