#include <algorithm>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include <mimicry/mesh/shapes.h>

#include "any_memory.h"
#include "presses.h"

namespace mimicry {
namespace {

// Uneven shapes: fingers, thin parts, noise.
std::vector<Target> uneven_shapes() {
  std::vector<Target> targets;
  targets.emplace_back(make_hand(2));
  targets.emplace_back(make_double_torus(2));
  targets.emplace_back(make_trefoil(6));
  targets.emplace_back(make_noisy_cube(10, 0.3, false, 7));
  return targets;
}

TEST(FirstPoint, OfAPenOnTheSurfaceIsThePenItself) {
  constexpr std::uint64_t kSeed = 11;
  int looked_at = 0;
  for (const Target& target : uneven_shapes()) {
    const Canvas canvas{target};
    for (const Press& press : presses(target, 100, kSeed)) {
      const Vec3 normal = face_normal(target.mesh(), press.hit.surface.face);
      for (const double off : {0.0, 1e-6, -1e-6, 1e-9, -1e-9}) {
        const Vec3 pen = press.hit.position + off * target.diagonal() * normal;
        for (const TechniqueInfo& info : techniques()) {
          if (!starts_at_the_pen(info)) continue;
          const AnyStep step = any_step(info, canvas, {}, frame_of(press, pen));
          ASSERT_NE(step.answer, Answer::miss) << info.name;
          // The pen's own distance, and that of a neighbouring sheet which is as near.
          ASSERT_LE((step.position - pen).norm(), 1.001e-6 * target.diagonal() + 1e-15)
              << info.name << ", off " << off << ", seed " << kSeed;
          ++looked_at;
        }
      }
    }
  }
  EXPECT_GT(looked_at, 10000);
}

// Where every frame's ray starts at the pen, so does that of a stroke along the surface.
TEST(FirstPoint, PensOnTheSurfaceNeverZigzag) {
  constexpr std::uint64_t kSeed = 12;
  int points = 0;  // strokes end where they come to the model's edge
  for (const Target& target : uneven_shapes()) {
    const Canvas canvas{target};
    for (const std::string_view name : {"spraycan", "occlude"}) {
      const TechniqueInfo& info = find_technique(name);
      for (const Press& press : presses(target, 4, kSeed)) {
        AnyMemory memory;
        for (int i = 0; i < 50; ++i) {
          const Vec3 across = press.direction.unitOrthogonal() * 1e-4 * i;
          const auto hit = target.first_hit(press.eye, press.direction + across);
          if (!hit || (hit->position - press.hit.position).norm() > 0.05 * target.diagonal()) break;
          const AnyStep step = any_step(info, canvas, memory, frame_of(press, hit->position, i));
          ASSERT_NE(step.answer, Answer::miss) << name << " " << i;
          EXPECT_LT((step.position - hit->position).norm(), 0.01 * target.diagonal())
              << name << " " << i;
          memory = step.memory;
          ++points;
        }
      }
    }
  }
  EXPECT_GT(points, 150);
}

TEST(DippedPen, StartsAtTheSurfaceItWentThrough) {
  constexpr std::uint64_t kSeed = 13;
  int inside = 0;
  for (const Target& target : uneven_shapes()) {
    const Canvas canvas{target};
    for (const Press& press : presses(target, 200, kSeed)) {
      // Along the ray, nearer to where it went in than to where it comes out.
      const double hair = 1e-5 * target.diagonal();
      const auto out =
          target.first_hit(press.hit.position + hair * press.direction, press.direction);
      if (!out || out->distance < 4.0 * hair) continue;
      const double depth = std::min(0.3 * out->distance, 0.005 * target.diagonal());
      const Vec3 pen = press.hit.position + depth * press.direction;
      for (const TechniqueInfo& info : techniques()) {
        if (!starts_at_the_pen(info) || info.name == "snap") continue;
        const AnyStep step =
            any_step(info, canvas, {}, frame_of(press, pen), options_with(info, "dipped-pen", 1.0));
        ASSERT_NE(step.answer, Answer::miss) << info.name;
        EXPECT_LE((step.position - press.hit.position).norm(), 0.01 * target.diagonal())
            << info.name << ", seed " << kSeed;
        ++inside;
      }
    }
  }
  EXPECT_GT(inside, 2000);
}

// A plate: from however deep, the side that the pen came through and not the other.
TEST(DippedPen, DoesNotComeOutOnTheFarSideOfAPlate) {
  const Target plate(make_box(8, 8, 1, Vec3(0.5, 0.5, 0.05)));
  const Canvas canvas{plate};
  const Vec3 eye(0.1, 0.05, 3.0);
  for (const double z : {0.04, 0.0, -0.03, -0.049}) {
    Frame frame;
    frame.head.position = eye;
    frame.controller.position = Vec3(0.1, 0.05, z);
    for (const std::string_view name : {"spraycan", "occlude", "mimicry-live"}) {
      const TechniqueInfo& info = find_technique(name);
      const AnyStep on = any_step(info, canvas, {}, frame, options_with(info, "dipped-pen", 1.0));
      EXPECT_NEAR(on.position.z(), 0.05, 1e-12) << name << " at " << z;
      // The paper's definition: the first hit of the ray, on the far side.
      const AnyStep off = any_step(info, canvas, {}, frame);
      EXPECT_NEAR(off.position.z(), -0.05, 1e-12) << name << " at " << z;
    }
    // A hand that reaches around and points at its owner.
    frame.controller.orientation = Quat(Eigen::AngleAxisd(EIGEN_PI, Vec3::UnitY()));
    if (z > -0.03) continue;
    const TechniqueInfo& spray = find_technique("spraycan");
    const AnyStep around =
        any_step(spray, canvas, {}, frame, options_with(spray, "dipped-pen", 1.0));
    EXPECT_NEAR(around.position.z(), -0.05, 1e-12) << "at " << z;
  }
}

TEST(DippedPen, ChangesNothingForAPenOutside) {
  constexpr std::uint64_t kSeed = 14;
  for (const Target& target : uneven_shapes()) {
    const Canvas canvas{target};
    for (const Press& press : presses(target, 50, kSeed)) {
      const Vec3 pen = press.eye + 0.9 * press.hit.distance * press.direction;
      for (const TechniqueInfo& info : techniques()) {
        if (!starts_at_the_pen(info)) continue;
        const AnyStep on =
            any_step(info, canvas, {}, frame_of(press, pen), options_with(info, "dipped-pen", 1.0));
        const AnyStep off = any_step(info, canvas, {}, frame_of(press, pen));
        ASSERT_EQ(on.position, off.position) << info.name;
        ASSERT_EQ(on.answer, off.answer) << info.name;
      }
    }
  }
}

// From inside a room its walls are drawn on: head and pen are both inside.
TEST(DippedPen, LeavesAHeadInsideAlone) {
  const Target room(make_sphere(12));
  Frame frame;
  frame.head.position = Vec3(0.0, 0.0, 0.1);
  frame.controller.position = Vec3(0.0, 0.0, -0.1);
  const TechniqueInfo& spray = find_technique("spraycan");
  const AnyStep step = any_step(spray, {room}, {}, frame, options_with(spray, "dipped-pen", 1.0));
  EXPECT_LT(step.position.z(), -0.5 * kSphereRadius);
}

}  // namespace
}  // namespace mimicry
