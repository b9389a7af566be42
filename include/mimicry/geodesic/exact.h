#pragma once

#include <memory>
#include <span>
#include <vector>

#include <mimicry/base/parallel.h>
#include <mimicry/mesh/half_edges.h>
#include <mimicry/mesh/surface.h>

namespace mimicry {

struct Source {
  SurfacePoint point;
  double distance = 0.0;  ///< the distance that it starts from, >= 0, model units
};

struct ExactOptions {
  /// Stop when all distances up to here are known, model units; points farther away count as
  /// unreachable.
  double radius = kInfinity;
  /// Stop as soon as the distances of these are known; empty: all points.
  std::span<const SurfacePoint> targets = {};
  /// Windows made before the search gives up, 0 for 10,000 and 500 for each face: a bound for
  /// meshes made to break it. Then `exact` is false and distances are upper bounds.
  std::size_t most_windows = 0;
  /// Told now and then how far the search is; false cancels it with Error(cancelled), after which
  /// distances are not known before the next `compute`.
  ProgressCallback progress = {};
};

/// A shortest path from a source to a point.
struct ExactPath {
  bool found = false;               ///< false where no source reaches the point
  std::size_t source = 0;           ///< number of the source that it starts at
  double length = 0.0;              ///< of the path itself, model units
  std::vector<Crossing> crossings;  ///< from the source to the point, exclusive of both
};

/// Exact geodesic distances from any number of surface points, by windows on edges (Mitchell, Mount
/// and Papadimitriou 1987; made practical by Surazhsky, Surazhsky, Kirsanov, Gortler and Hoppe
/// 2005), pruned with the distances of vertices (Xin and Wang 2009). The windows of an edge are
/// sent on together, as those of a triangle are by Qin et al. (2016), so that lists are merged in
/// one pass and the queue holds edges. Where we differ: a window is cut where it is not nearest
/// also in the rare case of two cuts, and distances in a sliver that rounding has left without a
/// window are measured around the ends of its neighbours. Boundary and non-manifold edges are not
/// crossed, but a vertex where several fans touch is passed from each into the others (unlike
/// `LocalPathFinder`); faces without area and edges without length are allowed. The surface must
/// not deform between `compute` and what is asked of it.
class ExactGeodesics {
 public:
  /// O(#V + #F). Throws Error(invalid_input) where a vertex is not finite.
  explicit ExactGeodesics(const Surface& surface);
  ~ExactGeodesics();
  ExactGeodesics(ExactGeodesics&&) noexcept;
  ExactGeodesics& operator=(ExactGeodesics&&) noexcept;

  /// Forgets what was computed before. Throws Error(invalid_input) for sources or targets off the
  /// mesh, a distance that is negative or not finite, or a radius that is negative or NaN. No
  /// sources: nothing is reachable. About O(#F^1.5) in practice; single thread.
  void compute(std::span<const Source> sources, const ExactOptions& options = {});
  void compute(const SurfacePoint& source, const ExactOptions& options = {});

  /// Model units; kInfinity where no source reaches the vertex, or the search stopped before. The
  /// vertex is one of the mesh's. After `compute`.
  double distance(Index vertex) const;
  /// Distance at any surface point. Throws Error(invalid_input) for one off the mesh. O(windows of
  /// its face's edges).
  double distance(const SurfacePoint& p) const;
  /// The shortest path to p, traced back through the windows. Throws Error(invalid_input) for p off
  /// the mesh. O(windows of the edges crossed).
  ExactPath path_to(const SurfacePoint& p) const;

  /// False after a search that gave up (`ExactOptions::most_windows`).
  bool exact() const;
  /// Windows made by the last computation, and the bytes that it holds.
  std::size_t windows_made() const;
  std::size_t memory_bytes() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace mimicry
