#include "spatial/triangle.h"

#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "spatial/meshes.h"

namespace mimicry {
namespace {

using test::Random;
using test::uniform;
using test::uniform_vector;

Vec3 at(const Triangle& t, const Vec3& bary) {
  return bary[0] * t.a + bary[1] * t.b + bary[2] * t.c;
}

void expect_sound(const Vec3& bary) {
  EXPECT_GE(bary.minCoeff(), 0.0);
  EXPECT_NEAR(bary.sum(), 1.0, 4e-16);
}

TEST(Triangle, EachRegionOfTheClosestPoint) {
  const Triangle t = {Vec3(0, 0, 0), Vec3(4, 0, 0), Vec3(0, 4, 0)};
  const auto check = [&](const Vec3& y, const Vec3& expected) {
    const TrianglePoint p = closest_point(t, y);
    EXPECT_LT((at(t, p.bary) - expected).norm(), 1e-15) << y.transpose();
    EXPECT_NEAR(std::sqrt(p.distance2), (y - expected).norm(), 1e-15);
  };
  check({1, 1, 3}, {1, 1, 0});
  check({1, -2, 1}, {1, 0, 0});
  check({-2, 1, 1}, {0, 1, 0});
  check({3, 3, -1}, {2, 2, 0});
  check({-1, -1, 1}, {0, 0, 0});
  check({6, -1, 1}, {4, 0, 0});
  check({-1, 6, 1}, {0, 4, 0});
}

// No point of the triangle is nearer, in shapes from fat to needle: the conditions of optimality,
// (y - p) . (corner - p) <= 0 for each corner.
TEST(Triangle, ClosestPointIsOptimalForFatAndThin) {
  Random random(31);
  for (int i = 0; i < 20000; ++i) {
    Triangle t;
    t.a = uniform_vector(random, 1.0);
    t.b = t.a + uniform_vector(random, 1.0);
    const double height = std::pow(10.0, uniform(random, -13.0, 0.0));
    t.c = t.a + uniform(random, -0.5, 1.5) * (t.b - t.a) + uniform_vector(random, height);
    const Vec3 y = t.a + uniform_vector(random, i % 2 == 0 ? 1.0 : 2.0 * height);
    const TrianglePoint p = closest_point(t, y);
    if (p.distance2 == kInfinity) continue;
    expect_sound(p.bary);
    const Vec3 x = at(t, p.bary);
    EXPECT_NEAR((y - x).norm(), std::sqrt(p.distance2), 1e-14);
    // Sampled, because a needle's optimality conditions are lost in rounding.
    for (int s = 0; s <= 20; ++s)
      for (int r = 0; r + s <= 20; ++r) {
        const Vec3 other = at(t, Vec3(20 - s - r, s, r) / 20.0);
        ASSERT_GE((y - other).norm(), std::sqrt(p.distance2) - 1e-14) << "height " << height;
      }
  }
}

TEST(Triangle, WithoutAreaIsNeverTheClosest) {
  const Vec3 a(0, 0, 0), b(1, 0, 0);
  for (const Triangle& t : {Triangle{a, b, b}, Triangle{a, a, a}, Triangle{a, 0.5 * b, b}}) {
    EXPECT_FALSE(has_area(t));
    EXPECT_EQ(closest_point(t, Vec3(0.2, 1, 0)).distance2, kInfinity);
  }
}

TEST(Triangle, NeighboursAgreeOnTheDistanceOfWhatTheyShare) {
  Random random(32);
  int ties = 0;
  for (int i = 0; i < 1000; ++i) {
    const Vec3 a(-1, 0, 0), b(1, 0.3, 0), up(0.1, 1, -1), down(0.2, -1, -1);
    const Vec3 y = Vec3(uniform(random, -1.5, 1.5), uniform(random, -0.1, 0.1), 0.7);
    const double one = closest_point({a, b, up}, y).distance2;
    const double other = closest_point({b, a, down}, y).distance2;
    EXPECT_NEAR(one, other, 1e-15);
    ties += one == other ? 1 : 0;
  }
  EXPECT_GT(ties, 990);
}

TEST(Triangle, RayHitsAtTheKnownPlace) {
  Random random(33);
  for (int i = 0; i < 2000; ++i) {
    const Triangle t = {uniform_vector(random, 1), uniform_vector(random, 1),
                        uniform_vector(random, 1)};
    const double u = uniform(random, 0.01, 0.49), v = uniform(random, 0.01, 0.49);
    const Vec3 bary(1 - u - v, u, v);
    const Vec3 origin = uniform_vector(random, 3.0);
    const Vec3 aim = at(t, bary);
    const double distance = (aim - origin).norm();
    // Conditioning: the error grows as the ray comes to lie in the triangle's plane.
    const Vec3 n = (t.b - t.a).cross(t.c - t.a);
    const double sine = std::abs(n.normalized().dot((aim - origin) / distance));
    if (sine < 1e-3 || n.norm() < 1e-2) continue;
    const auto hit = Ray(origin, (aim - origin) / distance).hit(t);
    ASSERT_TRUE(hit.has_value());
    expect_sound(hit->bary);
    EXPECT_LT((at(t, hit->bary) - aim).norm(), 1e-14 / sine / n.norm());
    EXPECT_NEAR(hit->t, distance, 1e-14 / sine / n.norm());
    EXPECT_FALSE(Ray(origin, (origin - aim) / distance).hit(t).has_value());
  }
}

TEST(Triangle, EdgeOnIsNoHit) {
  const Triangle t = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)};
  EXPECT_FALSE(Ray(Vec3(-1, 0.25, 0), Vec3(1, 0, 0)).hit(t).has_value());
}

// Corners, points of sides and near misses, from near and far, for large and tiny triangles.
TEST(TrianglePack, NeverDropsWhatTheExactTestsAccept) {
  Random random(34);
  int kept = 0, dropped = 0;
  for (int i = 0; i < 20000; ++i) {
    const double size = std::pow(10.0, uniform(random, -9.0, 0.0));
    const Vec3 place = uniform_vector(random, 0.5);
    Triangle::Pack pack;
    std::array<Triangle, 4> triangles;
    for (int lane = 0; lane < 4; ++lane) {
      Triangle& t = triangles[static_cast<std::size_t>(lane)];
      t = {place + uniform_vector(random, size), place + uniform_vector(random, size),
           place + uniform_vector(random, size)};
      if (i % 5 == 0) t.c = t.a + 0.3 * (t.b - t.a) + uniform_vector(random, 1e-12 * size);
      pack.set(lane, t);
    }
    const double s = random() % 3 == 0 ? 0.0 : uniform(random, 0.0, 1.0);
    const Vec3 aim = triangles[0].a + s * (triangles[0].b - triangles[0].a) +
                     uniform_vector(random, i % 2 == 0 ? 0.0 : 1e-7);
    const Vec3 y = aim + uniform_vector(random, std::pow(10.0, uniform(random, -9.0, 1.0)));
    const double bound2 = closest_point(triangles[0], y).distance2;
    if (bound2 < 1e30) {
      Triangle::Pack::NearSieve near(y, 1.0);
      near.set_bound(std::nextafter(static_cast<float>(bound2), 1e30F));
      const unsigned lanes = pack.candidates(near);
      for (unsigned lane = 0; lane < 4; ++lane) {
        const bool in = closest_point(triangles[lane], y).distance2 <= bound2;
        ASSERT_TRUE(!in || (lanes >> lane & 1U) != 0) << "size " << size;
        ++((lanes >> lane & 1U) != 0 ? kept : dropped);
      }
    }
    const Vec3 direction = (aim - y).normalized();
    const Ray ray(y, direction);
    const double far = (y - place).cwiseAbs().maxCoeff() + 2.0;
    Vec3 inverse;
    for (int k = 0; k < 3; ++k)
      inverse[k] = 1.0 / std::copysign(std::max(std::abs(direction[k]), 1e-18), direction[k]);
    Triangle::Pack::RaySieve sieve(y, direction, inverse, 1.0, far, 8e-15 * far);
    sieve.set_bound(1e30F);
    const unsigned lanes = pack.candidates(sieve);
    for (unsigned lane = 0; lane < 4; ++lane) {
      ASSERT_TRUE(!ray.hit(triangles[lane]) || (lanes >> lane & 1U) != 0) << "size " << size;
      ++((lanes >> lane & 1U) != 0 ? kept : dropped);
    }
  }
  EXPECT_GT(dropped, kept / 10);  // it sieves at all
}

}  // namespace
}  // namespace mimicry
