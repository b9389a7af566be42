#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include <mimicry/embedding/embedding.h>
#include <mimicry/phong/phong_surface.h>
#include <mimicry/spatial/bvh.h>
#include <mimicry/spatial/target.h>

namespace mimicry::embedding {

/// How a smooth closest point was found: all but `smooth` are plain closest points.
enum class ScpLabel : std::uint8_t {
  smooth,
  outside_shell,      ///< the query is in no tetrahedron
  no_phong_solution,  ///< no triangle has a solution
  replaced,           ///< failed the paper's test (`ScpOptions::replace_failed`)
};

struct SmoothPoint {
  SurfacePoint surface;
  Vec3 position = Vec3::Zero();
  ScpLabel label = ScpLabel::smooth;
};

struct ScpOptions {
  /// A point with |p - SCP(p)| > |p - snap(p)| + diagonal / 20 counts as failed (the paper's
  /// quality measure); with this it is replaced by the closest point.
  bool replace_failed = false;
};

/// Where a search may start; any numbers, kNone for nowhere. They save time and never change the
/// answer.
struct ScpHint {
  Index tet = kNone;
  Index face = kNone;
};

/// A place in the shell.
struct ShellPoint {
  Index tet = kNone;
  Eigen::Vector4d bary = Eigen::Vector4d::Zero();  ///< >= 0, sum 1
};

/// Smooth closest points SCP(y) on a target (Arora and Singh 2021, 3.2; Panozzo et al. 2013): y's
/// place in the shell's tetrahedra, the same combination of their positions in R^8, and its Phong
/// projection. Queries are const, safe from many threads, allocate nothing and give the same bits
/// every time. Refers to the target, which must outlive it.
class SmoothProjector {
 public:
  /// Throws Error(invalid_input) where the embedding is of another mesh or contradicts itself
  /// (sizes, vertex numbers, numbers that are not finite), Error(unsupported) above 8 dimensions.
  /// O(#T + #F log #F).
  SmoothProjector(Embedding embedding, const spatial::Target& target);
  SmoothProjector(const SmoothProjector&) = delete;
  SmoothProjector& operator=(const SmoothProjector&) = delete;

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
  phong::Vec8 lift(const ShellPoint& p) const;

  const spatial::Target& target() const { return *target_; }
  const phong::PhongSurface& surface() const { return surface_; }
  const Embedding& embedding() const { return embedding_; }
  std::size_t memory_bytes() const;

 private:
  struct Tetrahedron {
    using Pack = spatial::NoPack;  // the hierarchy holds numbers only

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
  const spatial::Target* target_;
  phong::PhongSurface surface_;
  spatial::Bvh<3, Tetrahedron> shell_;
};

}  // namespace mimicry::embedding
