#include "technique/section_walk.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include <mimicry/base/random.h>
#include <mimicry/mesh/shapes.h>
#include <mimicry/spatial/target.h>

namespace mimicry {
namespace {

// The start is drawn 1e-9 of its face inward.
constexpr double kInward = 1e-8;

Vec3 walk(const Target& target, const SurfacePoint& q, const Vec3& motion, const Vec3& normal,
          double length) {
  const SurfacePoint end = walk_section(target.surface(), q, motion, normal, length);
  EXPECT_GE(end.bary.minCoeff(), 0.0);
  EXPECT_NEAR(end.bary.sum(), 1.0, 1e-12);
  return target.position(end);
}

TEST(SectionWalk, OnAPlaneItIsAStraightLine) {
  const Target target(make_grid(8));
  Random random(21);
  for (int round = 0; round < 500; ++round) {
    // Inner points, points of edges and vertices of the grid; directions along its lines too.
    Vec3 from(random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5), 0.0);
    if (round % 3 == 1) from[0] = 0.25 * std::round(from[0] / 0.25);
    if (round % 3 == 2) from = 0.25 * (from / 0.25).array().round().matrix();
    const double angle = round % 2 ? random.uniform(0.0, 2.0 * std::numbers::pi)
                                   : 0.25 * std::numbers::pi * random.below(8);
    const Vec3 direction(std::cos(angle), std::sin(angle), 0.0);
    const double length = random.uniform(0.0, 0.45);
    const auto q = target.closest_point(from);
    const Vec3 end = walk(target, q->surface, direction, Vec3::UnitZ(), length);
    ASSERT_LT((end - (from + length * direction)).norm(), kInward) << "round " << round;
  }
}

TEST(SectionWalk, StopsAtTheBoundaryAndStaysWithoutAPlane) {
  const Target target(make_grid(8));
  const auto q = target.closest_point(Vec3(0.3, 0.11, 0));
  EXPECT_LT((walk(target, q->surface, Vec3::UnitX(), Vec3::UnitZ(), 5.0) - Vec3(1, 0.11, 0)).norm(),
            kInward);
  EXPECT_EQ(walk(target, q->surface, Vec3::UnitZ(), Vec3::UnitZ(), 1.0), q->position);
  EXPECT_EQ(walk(target, q->surface, Vec3::Zero(), Vec3::UnitZ(), 1.0), q->position);
  EXPECT_EQ(walk(target, q->surface, Vec3::UnitX(), Vec3::UnitZ(), 0.0), q->position);
}

TEST(SectionWalk, AroundABoxItComesBack) {
  const Target target(make_box(5, 5, 5, Vec3(0.8, 0.8, 0.8)));
  const auto q = target.closest_point(Vec3(0.1, 0.07, 0.8));
  for (const int rounds : {1, 3})
    EXPECT_LT(
        (walk(target, q->surface, Vec3::UnitX(), Vec3::UnitZ(), rounds * 6.4) - q->position).norm(),
        rounds * kInward);
  EXPECT_LT(
      (walk(target, q->surface, Vec3::UnitX(), Vec3::UnitZ(), 1.0) - Vec3(0.8, 0.07, 0.5)).norm(),
      kInward)
      << "over the edge";
}

TEST(SectionWalk, OnASphereItFollowsTheGreatCircle) {
  const int n = 24;
  const Target target(make_sphere(n));
  const auto q = target.closest_point(Vec3(0.3, 0.4, 1.0));
  const Vec3 normal = q->position.normalized();
  const Vec3 direction = normal.cross(Vec3(1, 2, 0)).normalized();
  const double error = *faceting_error("sphere", n);
  for (const double angle : {0.3, 1.0, 2.5, 6.0}) {
    const Vec3 end = walk(target, q->surface, direction, normal, angle);
    const Vec3 wanted = std::cos(angle) * normal + std::sin(angle) * direction;
    EXPECT_LT(std::abs(end.dot(normal.cross(direction))), 1e-8) << "leaves the plane";
    // Chords are shorter than the arc by less than the faces are below the sphere, each radian.
    EXPECT_LT((end - wanted).norm(), error * (1.0 + 2.0 * angle)) << angle;
  }
}

}  // namespace
}  // namespace mimicry
