#pragma once

#include <string>

#include <mimicry/base/error.h>
#include <mimicry/render/scene.h>

namespace mimicry::render {

[[noreturn]] inline void refuse(const std::string& message) {
  throw Error(ErrorKind::invalid_input, message);
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
