#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include <mimicry/base/random.h>
#include <mimicry/mesh/shapes.h>
#include <mimicry/study/simulate.h>
#include <mimicry/study/targets.h>
#include <mimicry/technique/technique.h>

#include "support/allocations.h"
#include "technique/steps.h"

namespace mimicry {
namespace {

using LiveStep = Stepped<SoftAnchor>;

SoftAnchorOptions soft() {
  SoftAnchorOptions options;
  options.soft_anchor = true;
  return options;
}

// A memory that is anchored at the point of the target closest to x, with the pen there.
SoftAnchor anchored_at(const Target& target, const Vec3& x) {
  SoftAnchor memory;
  const auto closest = target.closest_point(x);
  memory.anchored = true;
  memory.surface = closest->surface;
  memory.position = memory.pen = closest->position;
  return memory;
}

Frame moved(const SoftAnchor& memory, const Vec3& motion, double dt = 1.0 / 90) {
  Frame frame;
  frame.time_s = memory.time_s + dt;
  frame.controller.position = memory.pen + motion;
  return frame;
}

std::vector<LiveStep> draw(const Target& target, const Stroke& stroke,
                           const SoftAnchorOptions& options = {}, std::size_t every = 1) {
  const Canvas canvas{target, stroke.model_to_world.scale};
  std::vector<LiveStep> steps;
  SoftAnchor memory;
  for (std::size_t i = 0; i < stroke.frames.size(); i += every) {
    const Frame frame = to_model(stroke.frames[i], stroke.model_to_world);
    steps.push_back(mimicry_live(canvas, memory, frame, options));
    memory = steps.back().memory;
  }
  return steps;
}

Similarity placed(std::string_view shape) {
  return {Quat::Identity(), Vec3(0.1, 1.2, -0.4), find_shape(shape)->metres_per_unit};
}

std::vector<Index> components(const Target& target) {
  const HalfEdges& edges = target.half_edges();
  std::vector<Index> of(static_cast<std::size_t>(target.mesh().face_count()), kNone);
  for (Index seed = 0; seed < target.mesh().face_count(); ++seed) {
    if (of[static_cast<std::size_t>(seed)] != kNone) continue;
    std::vector<Index> open = {seed};
    while (!open.empty()) {
      const Index f = open.back();
      open.pop_back();
      if (of[static_cast<std::size_t>(f)] != kNone) continue;
      of[static_cast<std::size_t>(f)] = seed;
      for (Index h = 3 * f; h < 3 * f + 3; ++h)
        if (edges.has_twin(h)) open.push_back(HalfEdges::face(edges.twin(h)));
    }
  }
  return of;
}

TEST(MimicryLive, OnAPlaneItMimicsTheTangentialMotionExactly) {
  const Target target(make_grid(8));
  Random random(31);
  SoftAnchor memory = anchored_at(target, Vec3(0.1, -0.2, 0));
  for (int i = 0; i < 500; ++i) {
    Vec3 motion(random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1), random.uniform(-0.3, 0.3));
    if (std::abs(memory.position[0] + motion[0]) > 0.99) motion[0] *= -1;
    if (std::abs(memory.position[1] + motion[1]) > 0.99) motion[1] *= -1;
    const LiveStep step = mimicry_live({target}, memory, moved(memory, motion), {});
    ASSERT_EQ(step.answer, Answer::smooth) << i;
    const Vec3 wanted = memory.position + Vec3(motion[0], motion[1], 0);
    ASSERT_LT((step.position - wanted).norm(), 1e-13) << i;
    memory = step.memory;
  }
}

TEST(MimicryLive, OnASphereItFollowsTheGreatCircleAndIgnoresRadialMotion) {
  const int n = 24;
  const Target target(make_sphere(n));
  const double error = *faceting_error("sphere", n);
  const Vec3 start = Vec3(0.2, 0.9, 0.3).normalized();
  const Vec3 across = start.cross(Vec3::UnitX()).normalized();
  SoftAnchor memory = anchored_at(target, start);
  // The hand runs along the same circle beside the sphere, so that the points run with it.
  const int count = 400;
  const double angle = 2.0;
  Vec3 last = start;
  for (int i = 1; i <= count; ++i) {
    const double a = angle * i / count;
    const Vec3 next = std::cos(a) * start + std::sin(a) * across;
    const LiveStep step = mimicry_live({target}, memory, moved(memory, next - last), {});
    ASSERT_EQ(step.answer, Answer::smooth);
    memory = step.memory;
    last = next;
    ASSERT_LT((memory.position - next).norm(), 4.0 * error) << i;
  }
  // Interpolated normals of the mesh differ from the radius by about the faces' tilt, h error / 2.
  const Vec3 q = memory.position;
  for (const double radial : {0.05, -0.04, 0.2, -0.3}) {
    const LiveStep step =
        mimicry_live({target}, memory, moved(memory, radial * q.normalized()), {});
    EXPECT_LT((step.position - q).norm(), 0.01 * std::abs(radial)) << radial;
  }
}

TEST(MimicryLive, NoStepIsLongerThanFiveTimesTheHands) {
  for (const std::string_view shape :
       {"sphere", "torus", "rounded-cube", "cube", "trefoil", "hand"}) {
    const Target target(make_shape(shape));
    for (const Intention& curve : intended_curves(shape, target))
      for (const bool is_soft : {false, true}) {
        const auto stroke = simulate(target, curve, placed(shape), {}, 5);
        const auto steps = draw(target, stroke, is_soft ? soft() : SoftAnchorOptions{});
        for (std::size_t i = 1; i < steps.size(); ++i) {
          if (!steps[i - 1].memory.anchored) continue;
          const double dp = (steps[i].memory.pen - steps[i - 1].memory.pen).norm();
          if (dp * stroke.model_to_world.scale < 0.5e-3) continue;
          ASSERT_LE((steps[i].position - steps[i - 1].position).norm(), 5.0 * dp)
              << shape << " " << curve.name << " seed 5, frame " << i << (is_soft ? " soft" : "");
        }
      }
  }
}

TEST(MimicryLive, HardTargetsGiveSoundPointsOfTheSameComponent) {
  std::vector<Vec3> thin;
  const TriangleMesh grid = make_grid(12);
  for (const Vec3& x : grid.positions()) thin.emplace_back(1e-7 * x[0], x[1], 0.1 * x[0] * x[1]);
  const TriangleMesh one({Vec3(-1, -1, 0), Vec3(1, -1, 0), Vec3(0, 1, 0)}, {{0, 1, 2}});
  const std::array<TriangleMesh, 8> meshes = {make_noisy_cube(12, 0.2, true, 3),
                                              make_two_spheres(8),
                                              grid,
                                              grid.with_positions(thin),
                                              one,
                                              make_moebius_strip(32),
                                              make_cylinder(6),
                                              make_shape("plate")};
  for (std::size_t m = 0; m < meshes.size(); ++m) {
    const Target target(meshes[m]);
    const auto component = components(target);
    Random random(40 + m);
    for (const SoftAnchorOptions& options : {SoftAnchorOptions{}, soft()}) {
      SoftAnchor memory = anchored_at(
          target, target.position({static_cast<Index>(random.below(
                                       static_cast<std::uint32_t>(target.mesh().face_count()))),
                                   Vec3(0.2, 0.3, 0.5)}));
      const Index home = component[static_cast<std::size_t>(memory.surface.face)];
      for (int i = 0; i < 3000; ++i) {
        // From a thousandth of the target to several times its size.
        const double length = target.diagonal() * std::pow(10.0, random.uniform(-6.0, 0.5));
        const Vec3 motion =
            length * Vec3(random.normal(), random.normal(), random.normal()).normalized();
        const LiveStep step = mimicry_live({target}, memory, moved(memory, motion), options);
        ASSERT_NE(step.answer, Answer::miss);
        ASSERT_GE(step.surface.bary.minCoeff(), 0.0) << "mesh " << m << " step " << i;
        ASSERT_NEAR(step.surface.bary.sum(), 1.0, 1e-12);
        ASSERT_LT((target.position(step.surface) - step.position).norm(),
                  1e-12 * target.diagonal());
        ASSERT_EQ(component[static_cast<std::size_t>(step.surface.face)], home)
            << "mesh " << m << " step " << i;
        if (!options.soft_anchor) {
          ASSERT_LE((step.position - memory.position).norm(), 2.5001 * length)
              << "mesh " << m << " step " << i;
        }
        memory = step.memory;
      }
    }
  }
}

TEST(MimicryLive, HandsAtRestAndFarAwayAreSafe) {
  const Target target(make_sphere(8));
  const SoftAnchor memory = anchored_at(target, Vec3(0, 0, 1));
  const LiveStep rest = mimicry_live({target}, memory, moved(memory, Vec3::Zero(), 0.0), soft());
  EXPECT_EQ(rest.position, memory.position);
  for (const double far : {1e3, 1e30, 1e59})
    EXPECT_TRUE(mimicry_live({target}, memory, moved(memory, Vec3(far, 0, 0)), soft())
                    .position.allFinite());
  const LiveStep beyond = mimicry_live({target}, memory, moved(memory, Vec3(1e200, 0, 0)), {});
  EXPECT_EQ(beyond.answer, Answer::miss);
  EXPECT_EQ(beyond.memory.pen, memory.pen);
}

TEST(MimicryLive, UnitsDoNotMatter) {
  const TriangleMesh mesh = make_shape("rounded-cube");
  const Target reference(mesh);
  for (const double unit : {1e-6, 1e6}) {
    std::vector<Vec3> positions;
    for (const Vec3& x : mesh.positions()) positions.push_back(unit * x);
    const Target target(mesh.with_positions(positions));
    SoftAnchor a = anchored_at(reference, Vec3(0.1, 0.2, 1.0));
    SoftAnchor b = anchored_at(target, unit * Vec3(0.1, 0.2, 1.0));
    Random random(51);
    for (int i = 0; i < 500; ++i) {
      const Vec3 motion = 0.02 * Vec3(random.normal(), random.normal(), random.normal());
      const LiveStep x = mimicry_live({reference, 1.0}, a, moved(a, motion), soft());
      const LiveStep y = mimicry_live({target, 1.0 / unit}, b, moved(b, unit * motion), soft());
      ASSERT_EQ(x.answer, y.answer) << unit << " " << i;
      ASSERT_LT((y.position / unit - x.position).norm(), 1e-10) << unit << " " << i;
      a = x.memory;
      b = y.memory;
    }
  }
}

TEST(MimicryLive, SameBitsAndNoAllocation) {
  const Target target(make_noisy_cube(16, 0.2, true, 7));
  const Canvas canvas{target};
  std::vector<LiveStep> first;
  first.reserve(2000);
  bool walked = false;
  for (const bool again : {false, true}) {
    Random random(61);
    SoftAnchor memory = anchored_at(target, Vec3(0.1, 0.2, 1.0));
    const long before = test::allocation_count();
    for (std::size_t i = 0; i < 2000; ++i) {
      const Vec3 motion = 0.03 * Vec3(random.normal(), random.normal(), random.normal());
      const LiveStep step = mimicry_live(canvas, memory, moved(memory, motion), soft());
      memory = step.memory;
      walked = walked || step.answer == Answer::section;
      if (!again) {
        first.push_back(step);
      } else {
        ASSERT_EQ(step.position, first[i].position) << i;
        ASSERT_EQ(step.surface.face, first[i].surface.face) << i;
      }
    }
    EXPECT_EQ(test::allocation_count(), before);
  }
  EXPECT_TRUE(walked) << "the mesh is not rough enough to test the last resort";
}

TEST(SoftAnchor, WhatIsCarriedFadesAndIsLimited) {
  const Target target(make_grid(8));
  const SoftAnchor memory = anchored_at(target, Vec3(0.1, 0.1, 0));
  // 1 mm per unit, so that the first motion is one part; the limit of 6 mm is 6 units.
  const Canvas canvas{target, 0.001};
  const LiveStep up = mimicry_live(canvas, memory, moved(memory, Vec3(0, 0, 0.3)), soft());
  const double step_fade = std::exp(-0.5 / 90 / 0.12);  // the second half of the step's
  EXPECT_LT((up.memory.rest - step_fade * Vec3(0, 0, 0.3)).norm(), 1e-13);
  const LiveStep later =
      mimicry_live(canvas, up.memory, moved(up.memory, Vec3::Zero(), 0.24), soft());
  EXPECT_LT((later.memory.rest - std::exp(-2.0) * up.memory.rest).norm(), 1e-13);
  SoftAnchor far = up.memory;
  for (int i = 0; i < 5; ++i)
    far = mimicry_live(canvas, far, moved(far, Vec3(0, 0, 9.0)), soft()).memory;
  EXPECT_LT((far.rest - Vec3(0, 0, 6.0)).norm(), 1e-13);
  const LiveStep off = mimicry_live(canvas, memory, moved(memory, Vec3(0, 0, 1.0)), {});
  EXPECT_EQ(off.memory.rest, Vec3::Zero());
}

TEST(SoftAnchor, FrameRatesFrom30To240HzEndWithinAMillimetre) {
  for (const std::string_view shape : {"sphere", "torus", "rounded-cube", "trefoil", "hand"}) {
    const Target target(make_shape(shape));
    for (const Intention& curve : intended_curves(shape, target)) {
      SimulationOptions options;
      options.rate_hz = 720;
      auto stroke = simulate(target, curve, placed(shape), options, 9);
      // All rates see the first frame, whose spray hits, and the last one.
      const auto steps = draw(target, stroke);
      const auto waiting = std::find_if(steps.begin(), steps.end(),
                                        [](const LiveStep& s) { return s.answer != Answer::miss; });
      stroke.frames.erase(stroke.frames.begin(), stroke.frames.begin() + (waiting - steps.begin()));
      stroke.frames.resize((stroke.frames.size() - 1) / 24 * 24 + 1);
      const Vec3 reference = draw(target, stroke, soft(), 8).back().position;  // 90 Hz
      for (const std::size_t every : {24u, 3u}) {
        const Vec3 end = draw(target, stroke, soft(), every).back().position;
        EXPECT_LT((end - reference).norm() * stroke.model_to_world.scale, 1e-3)
            << shape << " " << curve.name << " seed 9, " << 720 / every << " Hz";
      }
    }
  }
}

}  // namespace
}  // namespace mimicry
