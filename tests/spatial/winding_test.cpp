#include "spatial/winding.h"

#include <cmath>

#include <gtest/gtest.h>

#include <mimicry/base/random.h>
#include <mimicry/mesh/shapes.h>

#include "spatial/pseudonormal.h"
#include "support/allocations.h"

namespace mimicry {
namespace {

Vec3 normal_vector(mimicry::Random& random) {
  return {random.normal(), random.normal(), random.normal()};
}

TEST(WindingNumber, IsOneInsideAndZeroOutside) {
  mimicry::Random random(1);
  const WindingNumber winding(make_sphere(12));
  for (int i = 0; i < 500; ++i) {
    const Vec3 u = normal_vector(random).normalized();
    EXPECT_NEAR(winding.at(random.uniform(0.0, 0.95) * u), 1.0, 0.05);
    EXPECT_NEAR(winding.at(random.uniform(1.05, 20.0) * u), 0.0, 0.05);
  }
  EXPECT_NEAR(winding.at(Vec3(1e50, 0, 0)), 0.0, 1e-12);
  EXPECT_EQ(WindingNumber(TriangleMesh()).at(Vec3::Zero()), 0.0);
}

TEST(WindingNumber, FastIsCloseToTheSumOfAllAngles) {
  mimicry::Random random(2);
  for (const TriangleMesh& mesh :
       {make_torus(40, 20), make_grid(20), make_noisy_cube(9, 0.2, true, 1), make_two_spheres(6)}) {
    const WindingNumber winding(mesh), precise(mesh, {12.0});
    for (int i = 0; i < 300; ++i) {
      const Vec3 y = 0.8 * normal_vector(random);
      const double exact = winding.at_exhaustively(y);
      EXPECT_NEAR(winding.at(y), exact, 0.05);
      EXPECT_NEAR(precise.at(y), exact, 0.004);
    }
  }
}

TEST(SignedDistance, OfASphereIsTheRadiusLessOne) {
  mimicry::Random random(3);
  const Target target(make_sphere(24));
  const WindingNumber winding(target.mesh());
  const double facets = *faceting_error("sphere", 24);
  for (int i = 0; i < 500; ++i) {
    const Vec3 y = random.uniform(0.3, 2.0) * normal_vector(random).normalized();
    const auto d = signed_distance(target, winding, y);
    ASSERT_TRUE(d);
    // Facets lie inside the sphere.
    EXPECT_GE(d->distance, y.norm() - 1.0 - 1e-12);
    EXPECT_LE(d->distance, y.norm() - 1.0 + facets);
    EXPECT_NEAR(d->gradient.norm(), 1.0, 1e-12);
  }
}

TEST(SignedDistance, GradientEqualsFiniteDifferences) {
  mimicry::Random random(4);
  const Target target(make_torus(30, 15));
  const WindingNumber winding(target.mesh());
  int smooth = 0;
  for (int i = 0; i < 300; ++i) {
    const Vec3 y = 0.7 * normal_vector(random);
    const auto d = signed_distance(target, winding, y);
    if (std::abs(d->distance) < 0.01) continue;
    constexpr double kStep = 1e-5;
    Vec3 slope;
    for (int k = 0; k < 3; ++k)
      slope[k] = (signed_distance(target, winding, y + kStep * Vec3::Unit(k))->distance -
                  signed_distance(target, winding, y - kStep * Vec3::Unit(k))->distance) /
                 (2.0 * kStep);
    // Second derivatives are below 100; a step over the medial axis is rare.
    if ((slope - d->gradient).norm() < 2e-3) ++smooth;
    const auto g = distance_gradient(target, y);
    EXPECT_LT((*g * (d->distance < 0.0 ? -1.0 : 1.0) - d->gradient).norm(), 1e-12);
  }
  EXPECT_GT(smooth, 270);
}

TEST(Pseudonormal, OnFacesEdgesAndVerticesOfACube) {
  const Target target(make_box(2, 2, 2, Vec3::Constant(1.0)));
  const auto at = [&](const Vec3& x) {
    return pseudonormal(target, target.closest_point(x)->surface);
  };
  EXPECT_LT((at(Vec3(0.3, 0.2, 1.0)) - Vec3::UnitZ()).norm(), 1e-12);
  EXPECT_LT((at(Vec3(0.3, 1.0, 1.0)) - Vec3(0, 1, 1).normalized()).norm(), 1e-12);
  EXPECT_LT((at(Vec3(1.0, 1.0, 1.0)) - Vec3(1, 1, 1).normalized()).norm(), 1e-12);
  // On the surface the gradient is that normal.
  const auto g = distance_gradient(target, Vec3(0.3, 1.0, 1.0));
  EXPECT_LT((*g - Vec3(0, 1, 1).normalized()).norm(), 1e-12);
  EXPECT_FALSE(distance_gradient(target, Vec3(kInfinity, 0, 0)));
}

TEST(SignedDistance, AllocatesNothing) {
  const Target target(make_sphere(8));
  const WindingNumber winding(target.mesh());
  const long before = test::allocation_count();
  int inside = 0, outside = 0;
  for (int i = 0; i < 20; ++i) {
    const auto distance = signed_distance(target, winding, Vec3(0.1 * i, 0.2, 0.3));
    if (distance) ++(distance->distance < 0.0 ? inside : outside);
  }
  EXPECT_EQ(test::allocation_count(), before);
  EXPECT_GT(inside, 5);
  EXPECT_EQ(inside + outside, 20);
}

}  // namespace
}  // namespace mimicry
