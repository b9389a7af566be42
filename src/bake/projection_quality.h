#pragma once

#include <cstddef>

#include <mimicry/base/parallel.h>
#include <mimicry/embedding/smooth_projector.h>

namespace mimicry {

/// How well smooth closest points do in the whole shell and on the surface.
struct ProjectionQuality {
  /// Four for each tetrahedron but those that lie farther from the surface than the bake's offset:
  /// there the paper's tetrahedra end, and ours reach beyond.
  std::size_t queries = 0;
  /// Percentage of them with |p - SCP(p)| > |p - snap(p)| + diagonal / 20: the paper's "fail".
  double fail_percent = 0.0;
  /// Percentages of them whose answer is the closest point, since nothing else was found.
  double no_solution_percent = 0.0, outside_percent = 0.0;
  /// Of those that lie farther.
  std::size_t beyond_queries = 0;
  double beyond_fail_percent = 0.0;
  /// Largest |p - SCP(p)| of points p of the surface (each vertex; of each face a point on each
  /// edge and three inside), in diagonals; and how many of them are off by more than 1e-9.
  double surface_error = 0.0;
  std::size_t surface_queries = 0, surface_misses = 0;
};

/// Failed points are not replaced here. The points are drawn at random, seeded by the number of
/// their tetrahedron or face: the same whatever the number of threads. About 4 microseconds a
/// query. Throws Error(cancelled).
ProjectionQuality projection_quality(const SmoothProjector& projector, Executor& executor,
                                     const ProgressCallback& progress = {});

}  // namespace mimicry
