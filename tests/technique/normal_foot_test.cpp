#include "technique/normal_foot.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include <mimicry/base/random.h>

#include "technique/cubic_roots.h"

namespace mimicry {
namespace {

TEST(CubicRoots, FindsWhatTheCoefficientsWereMadeFrom) {
  Random random(11);
  for (int round = 0; round < 3000; ++round) {
    const double scale = std::pow(10.0, random.uniform(-30, 30));
    const double a = random.uniform(-1.5, 1.5), b = random.uniform(-1.5, 1.5),
                 c = random.uniform(-1.5, 1.5);
    const CubicRoots roots = cubic_roots(-a * b * c * scale, (a * b + b * c + c * a) * scale,
                                         -(a + b + c) * scale, scale);
    std::vector<double> wanted;
    for (const double t : {a, b, c})
      if (std::abs(t) <= 1.0) wanted.push_back(t);
    std::sort(wanted.begin(), wanted.end());
    const double gap = std::min({std::abs(a - b), std::abs(b - c), std::abs(c - a)});
    double margin = gap;
    for (const double t : {a, b, c}) margin = std::min(margin, std::abs(std::abs(t) - 1.0));
    if (margin < 1e-3) continue;  // the coefficients do not tell how many there are, or where
    ASSERT_EQ(static_cast<std::size_t>(roots.count), wanted.size()) << "round " << round;
    for (std::size_t i = 0; i < wanted.size(); ++i)
      ASSERT_NEAR(roots.t[i], wanted[i], 1e-15 / (gap * gap)) << "round " << round;
  }
}

TEST(CubicRoots, LeadingCoefficientsMayVanish) {
  for (const double nearly : {0.0, 1e-300, 1e-18, -1e-18}) {
    const CubicRoots quadratic = cubic_roots(-0.06, 0.1, 1.0, nearly);  // (t - 0.2)(t + 0.3)
    ASSERT_EQ(quadratic.count, 2) << nearly;
    EXPECT_NEAR(quadratic.t[0], -0.3, 1e-15);
    EXPECT_NEAR(quadratic.t[1], 0.2, 1e-15);
    const CubicRoots linear = cubic_roots(1.0, -4.0, nearly, nearly);
    ASSERT_EQ(linear.count, 1) << nearly;
    EXPECT_NEAR(linear.t[0], 0.25, 1e-15);
    EXPECT_EQ(cubic_roots(1.0, nearly, nearly, nearly).count, 0);
  }
  EXPECT_EQ(cubic_roots(0.0, 0.0, 0.0, 0.0).count, 0);
  EXPECT_EQ(cubic_roots(0.25, -1.0, 1.0, 0.0).count, 1) << "touches at 0.5";
  EXPECT_EQ(cubic_roots(0.0, 0.0, 0.0, 5.0).count, 1) << "triple root";
}

struct Case {
  NormalTriangle triangle;
  Vec3 bary;
  double t;
  Vec3 r;
};

// A triangle of size 1 with normals that lean up to about 60 degrees, and a point above it.
Case make_case(Random& random) {
  Case c;
  const auto vector = [&] { return Vec3(random.normal(), random.normal(), random.normal()); };
  do {
    for (Vec3& a : c.triangle.corners) a = vector();
  } while ((c.triangle.corners[1] - c.triangle.corners[0])
               .cross(c.triangle.corners[2] - c.triangle.corners[0])
               .norm() < 0.1);
  const Vec3 up = (c.triangle.corners[1] - c.triangle.corners[0])
                      .cross(c.triangle.corners[2] - c.triangle.corners[0])
                      .normalized();
  const double lean = random.uniform(0.0, 0.8);
  for (Vec3& n : c.triangle.normals) n = (up + lean * vector().normalized()).normalized();
  c.bary = Vec3(random.uniform(), random.uniform(), random.uniform());
  c.bary /= c.bary.sum();
  c.t = random.uniform(-1.0, 1.0);
  c.r = Vec3::Zero();
  for (int k = 0; k < 3; ++k) {
    const auto i = static_cast<std::size_t>(k);
    c.r += c.bary[k] * (c.triangle.corners[i] + c.t * c.triangle.normals[i]);
  }
  return c;
}

TEST(NormalFoot, TheNormalAtTheFootPassesThroughThePoint) {
  Random random(12);
  int others = 0;
  for (int round = 0; round < 3000; ++round) {
    const Case c = make_case(random);
    for (const double scale : {1.0, 1e-6, 1e6}) {
      NormalTriangle triangle = c.triangle;
      for (Vec3& a : triangle.corners) a = scale * a;
      const NormalFoot foot = normal_foot(triangle, scale * c.r, scale * 2.0, scale * 1e-9);
      ASSERT_TRUE(foot.found && foot.inside) << "round " << round << " scale " << scale;
      Vec3 x = Vec3::Zero(), n = Vec3::Zero();
      for (int k = 0; k < 3; ++k) {
        x += foot.bary[k] * triangle.corners[static_cast<std::size_t>(k)];
        n += foot.bary[k] * triangle.normals[static_cast<std::size_t>(k)];
      }
      const Vec3 way = scale * c.r - x;
      ASSERT_GE(foot.bary.minCoeff(), 0.0);
      ASSERT_NEAR(foot.bary.sum(), 1.0, 1e-14);
      ASSERT_LT(way.cross(n).norm(), 2e-9 * scale) << "round " << round;
      ASSERT_NEAR(foot.distance, way.norm(), 1e-12 * scale);
      // The point was made from one foot; the answer is that or a nearer one.
      Vec3 made = Vec3::Zero();
      for (int k = 0; k < 3; ++k)
        made += c.bary[k] * c.triangle.normals[static_cast<std::size_t>(k)];
      ASSERT_LE(foot.distance, scale * (std::abs(c.t) * made.norm() + 1e-7)) << "round " << round;
      if ((foot.bary - c.bary).norm() > 1e-5) ++others;
    }
  }
  EXPECT_LT(others, 300) << "mostly there is one foot";
}

TEST(NormalFoot, OverAFlatPatchItIsThePerpendicular) {
  const NormalTriangle flat = {{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)},
                               {Vec3::UnitZ(), Vec3::UnitZ(), Vec3::UnitZ()}};
  const NormalFoot foot = normal_foot(flat, Vec3(0.2, 0.3, -0.7), 4.0, 1e-9);
  ASSERT_TRUE(foot.inside);
  EXPECT_LT((foot.bary - Vec3(0.5, 0.2, 0.3)).norm(), 1e-15);
  const NormalFoot outside = normal_foot(flat, Vec3(-0.2, 0.3, 0.1), 4.0, 1e-9);
  ASSERT_TRUE(outside.found);
  EXPECT_FALSE(outside.inside);
  EXPECT_NEAR(outside.bary[1], -0.2, 1e-15) << "tells over which edge to go on";
  EXPECT_FALSE(normal_foot(flat, Vec3(0.2, 0.3, 5.0), 4.0, 1e-9).found) << "beyond the reach";
}

TEST(NormalFoot, NeedlesGiveNoneOrASoundOne) {
  const std::array<Vec3, 3> normals = {Vec3(0.1, 0, 1).normalized(), Vec3(0, 0.2, 1).normalized(),
                                       Vec3(-0.1, 0, 1).normalized()};
  for (const double height : {0.0, 1e-16, 1e-13, 1e-9, 1e-6}) {
    const NormalTriangle needle = {{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0.5, height, 0)}, normals};
    const NormalFoot foot = normal_foot(needle, Vec3(0.4, 0.3 * height, 0.2), 1.0, 1e-9);
    if (!foot.found) continue;
    Vec3 x = Vec3::Zero(), n = Vec3::Zero();
    for (int k = 0; k < 3; ++k) {
      x += foot.bary[k] * needle.corners[static_cast<std::size_t>(k)];
      n += foot.bary[k] * needle.normals[static_cast<std::size_t>(k)];
    }
    EXPECT_LT((Vec3(0.4, 0.3 * height, 0.2) - x).cross(n).norm(), 3e-9) << height;
  }
  const std::array<Vec3, 3> up = {Vec3::UnitZ(), Vec3::UnitZ(), Vec3::UnitZ()};
  const NormalTriangle segment = {{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(2, 0, 0)}, up};
  EXPECT_FALSE(normal_foot(segment, Vec3(0.4, 0.0, 0.2), 10.0, 1e-9).found);
  const NormalTriangle point = {{Vec3::Ones(), Vec3::Ones(), Vec3::Ones()}, up};
  EXPECT_FALSE(normal_foot(point, Vec3(1, 1, 2), 10.0, 1e-9).found);
}

}  // namespace
}  // namespace mimicry
