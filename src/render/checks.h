#pragma once

#include <cmath>
#include <string>

#include <mimicry/base/error.h>

#include "render/scene.h"

namespace mimicry::render {

[[noreturn]] inline void refuse(const std::string& message) {
  throw Error(ErrorKind::invalid_input, message);
}

// Finiteness comes first in checks: to compare a NaN, or to subtract infinities as allFinite does,
// is an invalid operation, which traps where traps are on.

inline bool finite(const Vec3& p) {
  return std::isfinite(p.x()) && std::isfinite(p.y()) && std::isfinite(p.z());
}

inline bool within(double value, double low, double high) {
  return std::isfinite(value) && value >= low && value <= high;
}

inline bool positive(double value) {
  return std::isfinite(value) && value > 0.0;
}

/// "tube 3 (snap)", for messages.
std::string tube_name(const Scene& scene, std::size_t t);

/// Throws Error(invalid_input) on whatever `Scene`'s comments rule out and on a scene without
/// anything to see.
void check(const Scene& scene);

/// Calls visit(point, radius) for all vertices that a face refers to (radius 0) and all points of
/// tubes.
template <typename Visit>
void for_each_point(const Scene& scene, const Visit& visit) {
  for (const Surface& surface : scene.surfaces) {
    for (const Face& face : surface.mesh->faces()) {
      for (const Index v : face) visit(surface.mesh->position(v), 0.0);
    }
  }
  for (const Tube& tube : scene.tubes) {
    for (const Vec3& p : tube.points) visit(p, tube.radius);
  }
}

/// Box of everything that `for_each_point` visits, with the radii.
Eigen::AlignedBox3d bounds(const Scene& scene);

}  // namespace mimicry::render
