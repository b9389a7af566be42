#pragma once

#include <mimicry/bake/bake.h>
#include <mimicry/embedding/smooth_projector.h>
#include <mimicry/technique/technique.h>

namespace mimicry::test {

/// A target with a quick bake: few samples, as the tests' shapes are simple.
struct BakedTarget {
  Target target;
  SmoothProjector projector;

  explicit BakedTarget(const TriangleMesh& mesh) : target(mesh), projector(baked(mesh), target) {}
  Canvas canvas() const { return {target, 1.0, projector}; }

  static Embedding baked(const TriangleMesh& mesh) {
    BakeOptions options;
    options.samples = 120;
    return mimicry::bake(mesh, options);
  }
};

}  // namespace mimicry::test
