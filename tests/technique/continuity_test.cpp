#include <gtest/gtest.h>

#include <mimicry/mesh/shapes.h>
#include <mimicry/study/intended_curves.h>
#include <mimicry/study/simulate.h>

#include "support/baked.h"

namespace mimicry::technique {
namespace {

constexpr double kStep = 1e-3;  // metres

// The hand's path in steps of kStep.
std::vector<stroke::Frame> even_steps(const std::vector<stroke::Frame>& frames) {
  std::vector<stroke::Frame> result = {frames.front()};
  for (const stroke::Frame& f : frames) {
    const Vec3 from = result.back().controller.position;
    const Vec3 way = f.controller.position - from;
    const int count = static_cast<int>(way.norm() / kStep);
    for (int k = 1; k <= count; ++k) {
      result.push_back(f);
      result.back().controller.position = from + k * kStep * way.normalized();
    }
  }
  return result;
}

// A short part of what continuity_bench sweeps: shapes whose parts come close to each other.
TEST(Continuity, NoStepIsLongerThanFiveTimesTheHands) {
  struct Case {
    std::string_view shape;
    int resolution;
    std::size_t curve;
  };
  for (const Case& c : {Case{"trefoil", 10, 0}, Case{"trefoil", 10, 1}, Case{"plate", 24, 0},
                        Case{"plate", 24, 1}, Case{"hand", 2, 1}}) {
    const test::BakedTarget baked(make_shape(c.shape, {.resolution = c.resolution}));
    const Similarity place{Quat::Identity(), Vec3(0, 1.2, 0), find_shape(c.shape)->metres_per_unit};
    Canvas canvas = baked.canvas();
    canvas.metres_per_unit = place.scale;
    const auto curves = study::intended_curves(c.shape, baked.target);
    const auto frames =
        even_steps(study::simulate(baked.target, curves[c.curve], place, {}, 1).frames);
    for (const std::string_view name :
         {"mimicry", "mimicry-offset", "mimicry-parallel", "mimicry-live"}) {
      Memory memory;
      double worst = 0.0;
      for (const stroke::Frame& f : frames) {
        const Step step = find_technique(name).step(canvas, memory, to_model(f, place), {});
        if (memory.anchored && step.answer != Answer::miss)
          worst = std::max(worst, (step.position - memory.position).norm() /
                                      (step.memory.pen - memory.pen).norm());
        memory = step.memory;
      }
      EXPECT_LE(worst, 5.0) << c.shape << " " << c.curve << " " << name;
    }
  }
}

}  // namespace
}  // namespace mimicry::technique
