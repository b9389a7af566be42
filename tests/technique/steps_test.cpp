#include <array>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include <mimicry/mesh/shapes.h>
#include <mimicry/technique/technique.h>

#include "any_memory.h"

namespace mimicry {
namespace {

// A plane z = 0 (facing +z) leaves no doubt where each technique must land.
struct Plane {
  Target target{make_grid(8)};
  Canvas canvas{target};

  AnyStep step(std::string_view name, const Frame& frame, const AnyMemory& memory = {},
               const TechniqueOptions& options = {}) const {
    return any_step(find_technique(name), canvas, memory, frame, options);
  }
};

// The pen in front of the plane, turned about y by `yaw` from pointing straight at it.
Frame frame_at(const Vec3& pen, double yaw_rad = 0.0) {
  Frame frame;
  frame.controller = {pen, Quat(Eigen::AngleAxisd(yaw_rad, Vec3::UnitY()))};
  frame.head = {pen + Vec3(0.1, 0.2, 0.3), Quat::Identity()};
  return frame;
}

TEST(Techniques, SpraycanFollowsTheNozzle) {
  const Plane plane;
  const TechniqueStep straight = plane.step("spraycan", frame_at(Vec3(0.2, -0.1, 0.5)));
  EXPECT_EQ(straight.answer, Answer::ray);
  EXPECT_LT((straight.position - Vec3(0.2, -0.1, 0)).norm(), 1e-14);
  // A turn to the left by 30 degrees sends the spray to -x.
  const TechniqueStep turned =
      plane.step("spraycan", frame_at(Vec3(0.2, -0.1, 0.5), std::numbers::pi / 6));
  EXPECT_LT((turned.position - Vec3(0.2 - 0.5 / std::sqrt(3.0), -0.1, 0)).norm(), 1e-14);
  TechniqueOptions down;
  set_option(find_technique("spraycan"), down, "nozzle", std::array<double, 3>{0, -1, -1});
  const TechniqueStep nozzle = plane.step("spraycan", frame_at(Vec3(0.2, 0.4, 0.5)), {}, down);
  EXPECT_LT((nozzle.position - Vec3(0.2, -0.1, 0)).norm(), 1e-14);
}

TEST(Techniques, OccludeContinuesTheLineOfSight) {
  const Plane plane;
  const TechniqueStep step = plane.step("occlude", frame_at(Vec3(0.2, 0.1, 0.3)));
  EXPECT_LT((step.position - Vec3(0.1, -0.1, 0)).norm(), 1e-14);
  Frame inside = frame_at(Vec3(0.2, 0.1, 0.3));
  inside.head.position = inside.controller.position;
  EXPECT_EQ(plane.step("occlude", inside).answer, Answer::miss) << "no line of sight";
}

TEST(Techniques, HeadCentricFollowsTheHead) {
  const Plane plane;
  const TechniqueStep step = plane.step("head-centric", frame_at(Vec3(0.2, 0.1, 0.3)));
  EXPECT_LT((step.position - Vec3(0.3, 0.3, 0)).norm(), 1e-14);
}

TEST(Techniques, SnapTakesTheClosestPoint) {
  const Plane plane;
  const TechniqueStep step = plane.step("snap", frame_at(Vec3(0.2, 0.1, 0.3)));
  EXPECT_EQ(step.answer, Answer::closest);
  EXPECT_LT((step.position - Vec3(0.2, 0.1, 0)).norm(), 1e-14);
}

TEST(Techniques, AnchoredClosestWaitsForTheSprayThenMimicsTheMotion) {
  const Plane plane;
  const AnyStep waiting =
      plane.step("anchored-closest", frame_at(Vec3(0, 0, 0.5), std::numbers::pi));
  EXPECT_EQ(waiting.answer, Answer::miss) << "the spray points away";
  EXPECT_FALSE(waiting.memory.anchored);
  const AnyStep first =
      plane.step("anchored-closest", frame_at(Vec3(0, 0, 0.5), 0.5), waiting.memory);
  EXPECT_EQ(first.answer, Answer::ray);
  // From now on only the motion counts, wherever the nozzle points.
  const Vec3 motion(0.05, 0.02, -0.03);
  const AnyStep second =
      plane.step("anchored-closest", frame_at(Vec3(0, 0, 0.5) + motion, 2.0), first.memory);
  EXPECT_EQ(second.answer, Answer::closest);
  EXPECT_LT((second.position - (first.position + Vec3(0.05, 0.02, 0))).norm(), 1e-14);
}

TEST(Techniques, StepsArePure) {
  const Plane plane;
  for (const TechniqueInfo& info : techniques()) {
    if (info.needs_bake) continue;  // baked_test.cpp
    AnyMemory memory;
    for (int i = 0; i < 20; ++i) {
      const Frame frame = frame_at(Vec3(0.01 * i, 0.02 * i, 0.3 - 0.01 * i), 0.02 * i);
      const AnyStep a = any_step(info, plane.canvas, memory, frame);
      const AnyStep b = any_step(info, plane.canvas, memory, frame);
      ASSERT_EQ(a.answer, b.answer) << info.name;
      ASSERT_EQ(a.position, b.position) << info.name;
      ASSERT_EQ(a.surface.face, b.surface.face) << info.name;
      memory = a.memory;
    }
  }
}

TEST(Techniques, AMissLeavesTheAnchor) {
  const Plane plane;
  for (const std::string_view name : {"occlude", "spraycan", "head-centric"}) {
    const AnyStep first = plane.step(name, frame_at(Vec3(0.1, 0.1, 0.2)));
    ASSERT_NE(first.answer, Answer::miss) << name;
    Frame away = frame_at(Vec3(0.1, 0.1, 0.2), std::numbers::pi);
    // Between pen and plane: the line of sight leads away from the plane too.
    away.head = {Vec3(0.1, 0.1, 0.1), away.controller.orientation};
    const AnyStep second = plane.step(name, away, first.memory);
    EXPECT_EQ(second.answer, Answer::miss) << name;
    EXPECT_EQ(second.memory.surface.face, first.memory.surface.face) << name;
  }
}

}  // namespace
}  // namespace mimicry
