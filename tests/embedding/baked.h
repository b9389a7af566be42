#pragma once

#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <mimicry/bake/bake.h>
#include <mimicry/base/random.h>
#include <mimicry/embedding/smooth_projector.h>
#include <mimicry/mesh/shapes.h>

#include "support/sanitized.h"

namespace mimicry {

/// A shape with its bake.
struct Baked {
  std::string name;
  Target target;
  SmoothProjector projector;

  Baked(std::string n, const TriangleMesh& mesh)
      : name(std::move(n)), target(mesh), projector(baked(mesh), target) {}
  static Embedding baked(const TriangleMesh& mesh) {
    BakeOptions options;
    options.samples = 150;
    return mimicry::bake(mesh, options);
  }

  SurfacePoint random_point(Random& random) const {
    const auto count = static_cast<std::uint32_t>(target.mesh().face_count());
    SurfacePoint p{static_cast<Index>(random.below(count)), Vec3::Zero()};
    const double r = std::sqrt(random.uniform()), s = random.uniform();
    p.bary = Vec3(1.0 - r, r * (1.0 - s), r * s);
    return p;
  }
  // Within the shell but for a few.
  Vec3 query(Random& random, double reach = 0.055) const {
    const Vec3 away(random.normal(), random.normal(), random.normal());
    return target.position(random_point(random)) +
           random.uniform(0.0, reach) * target.diagonal() * away.normalized();
  }
};

// Baked once; every test reads them only.
inline const std::vector<std::unique_ptr<Baked>>& shapes() {
  static const auto all = [] {
    std::vector<std::unique_ptr<Baked>> list;
    list.push_back(std::make_unique<Baked>("sphere", make_sphere(7)));
    list.push_back(std::make_unique<Baked>("torus", make_torus(30, 14)));
    const int n = test::kSanitized ? 4 : 7;
    list.push_back(std::make_unique<Baked>("cube", make_box(n, n, n, Vec3::Constant(0.8))));
    list.push_back(std::make_unique<Baked>("grid", make_grid(14)));
    list.push_back(std::make_unique<Baked>("two-spheres", make_two_spheres(5)));
    list.push_back(std::make_unique<Baked>("thin", make_box(10, 10, 1, Vec3(0.5, 0.5, 0.0005))));
    return list;
  }();
  return all;
}
inline const Baked& sphere() {
  return *shapes()[0];
}

}  // namespace mimicry
