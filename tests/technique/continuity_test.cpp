#include <algorithm>
#include <initializer_list>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include <mimicry/mesh/shapes.h>
#include <mimicry/study/simulate.h>
#include <mimicry/study/targets.h>

#include "any_memory.h"
#include "support/baked.h"
#include "support/sanitized.h"

namespace mimicry {
namespace {

constexpr double kStep = 1e-3;  // metres

// The hand's path in steps of kStep.
std::vector<Frame> even_steps(const std::vector<Frame>& frames) {
  std::vector<Frame> result = {frames.front()};
  for (const Frame& f : frames) {
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

// The largest step on the surface per step of the hand is at most 5, along the shape's curves.
void expect_continuous(std::string_view shape, int resolution,
                       std::initializer_list<std::size_t> curves_drawn) {
  const test::BakedTarget baked(make_shape(shape, {.resolution = resolution}));
  const Similarity place{Quat::Identity(), Vec3(0, 1.2, 0), find_shape(shape)->metres_per_unit};
  Canvas canvas = baked.canvas();
  canvas.metres_per_unit = place.scale;
  const auto curves = intended_curves(shape, baked.target);
  for (const std::size_t curve : curves_drawn) {
    const auto frames = even_steps(simulate(baked.target, curves[curve], place, {}, 1).frames);
    for (const std::string_view name :
         {"mimicry", "mimicry-offset", "mimicry-parallel", "mimicry-live"}) {
      AnyMemory memory;
      double worst = 0.0;
      int steps = 0;
      for (const Frame& f : frames) {
        const AnyStep step = any_step(find_technique(name), canvas, memory, to_model(f, place));
        if (memory.anchored && step.answer != Answer::miss) {
          worst = std::max(worst, (step.position - memory.position).norm() /
                                      (step.memory.pen - memory.pen).norm());
          ++steps;
        }
        memory = step.memory;
      }
      EXPECT_GT(steps, 100) << shape << " " << curve << " " << name;
      EXPECT_LE(worst, 5.0) << shape << " " << curve << " " << name;
    }
  }
}

// A short part of what continuity_bench sweeps: shapes whose parts come close to each other.
TEST(Continuity, NoStepIsLongerThanFiveTimesTheHandsOnTheTrefoil) {
  expect_continuous("trefoil", 10, {0, 1});
}

TEST(Continuity, NoStepIsLongerThanFiveTimesTheHandsOnThePlate) {
  expect_continuous("plate", 24, {0, 1});
}

TEST(Continuity, NoStepIsLongerThanFiveTimesTheHandsOnTheHand) {
  if (test::kSanitized) GTEST_SKIP() << "the trefoil and the plate go the same ways, in less time";
  expect_continuous("hand", 2, {1});
}

}  // namespace
}  // namespace mimicry
