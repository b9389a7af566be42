#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include <mimicry/embedding/embedding.h>
#include <mimicry/spatial/target.h>

namespace mimicry {

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

class SmoothProjection;

/// Smooth closest points SCP(y) on a target (Arora and Singh 2021, 3.2; Panozzo et al. 2013): y's
/// place in the shell's tetrahedra, the same combination of their positions in R^8, and its Phong
/// projection. A handle: copies are cheap, and share the embedding and the target. Queries are
/// const, safe from many threads, allocate nothing and give the same bits every time.
class SmoothProjector {
 public:
  /// Holds nothing; it may only be assigned to, and asked whether it holds something.
  SmoothProjector() = default;
  /// Throws Error(invalid_input) where the embedding is of another mesh or contradicts itself
  /// (sizes, vertex numbers, numbers that are not finite), Error(unsupported) above 8 dimensions.
  /// O(#T + #F log #F).
  SmoothProjector(Embedding embedding, const Target& target);

  explicit operator bool() const { return projection_ != nullptr; }

  /// SCP(y), in the mesh's frame and units; nullopt where y is not finite (or beyond 1e60). hint:
  /// where to start; left with where to start for a query nearby.
  std::optional<SmoothPoint> project(const Vec3& y, const ScpOptions& options = {},
                                     ScpHint* hint = nullptr) const;
  /// The same by the exhaustive Phong projection: the oracle of `project`.
  std::optional<SmoothPoint> project_exhaustively(const Vec3& y,
                                                  const ScpOptions& options = {}) const;

  /// The point of the surface at the weighted sum of points in R^8 (Panozzo et al. 2013, 3).
  /// weights: as many as points, sum 1, negative ones allowed. Where nothing projects there, the
  /// closest point to the weighted sum in space (`no_phong_solution`). At least one point.
  SmoothPoint weighted_average(std::span<const SurfacePoint> points,
                               std::span<const double> weights, Index face_hint = kNone) const;

  const Target& target() const;
  const Embedding& embedding() const;
  /// Heap memory held, without the target's.
  std::size_t memory_bytes() const;

 private:
  friend const SmoothProjection& projection_of(const SmoothProjector& projector);

  std::shared_ptr<const SmoothProjection> projection_;
};

}  // namespace mimicry
