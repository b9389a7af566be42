#pragma once

#include <vector>

#include <mimicry/spatial/target.h>
#include <mimicry/study/simulate.h>

namespace mimicry {

inline Vec3 unit_or(const Vec3& v, const Vec3& otherwise) {
  const double length = v.norm();
  return length > 1e-9 ? Vec3(v / length) : otherwise;
}

/// The intended curve at equal steps of its length, in the world.
struct Path {
  bool closed = false;
  double step = 0;  // metres
  std::vector<Vec3> points;
  std::vector<Vec3> normals;
};

/// Throws Error(invalid_input) for a curve of another mesh, or of fewer than two distinct points.
Path resampled(const Target& target, const Intention& intended, const Similarity& place);

/// The hand's path for any distance: base + distance * away.
struct HandPath {
  std::vector<Vec3> base;
  std::vector<Vec3> away;
};

HandPath hand_path(const Path& path, const Target& target, const Similarity& place,
                   const SimulationOptions& options);

/// Where on the path (in steps) the hand is at each frame: two-thirds power law, from rest to rest.
std::vector<double> progress(const std::vector<Vec3>& hand, int frames, double step,
                             const SimulationOptions& options);

/// Between two points of a path. i: in steps, within it.
Vec3 sample(const std::vector<Vec3>& x, double i);

}  // namespace mimicry
