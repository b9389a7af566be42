#include "curve/self_crossing.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include <mimicry/base/random.h>
#include <mimicry/mesh/shapes.h>

#include "curve/support.h"

namespace mimicry {
namespace {

using test::Drawn;

bool crosses(const Drawn& drawn, const ProjectedCurve& curve) {
  return self_crossing(refine(curve, drawn.surface), drawn.mesh).has_value();
}

TEST(SelfCrossing, OfALoopAndNotOfAWave) {
  const Drawn grid{make_grid(10)};
  std::vector<Vec3> loop, wave;
  for (int i = 0; i <= 50; ++i) {
    const double t = 0.1 * i;
    wave.push_back(Vec3(-0.8 + 0.3 * t, 0.3 * std::sin(3.0 * t), 0));
    // A trochoid: it turns back on itself.
    loop.push_back(Vec3(-0.5 + 0.2 * t - 0.35 * std::sin(2.0 * t), 0.3 * std::cos(2.0 * t), 0));
  }
  EXPECT_FALSE(crosses(grid, grid.curve_near(wave)));
  EXPECT_TRUE(crosses(grid, grid.curve_near(loop)));
}

TEST(SelfCrossing, NamesTheSegments) {
  const Drawn grid{make_grid(1)};  // two faces: every point its own node, crossings between
  const auto curve = grid.curve_near(std::vector<Vec3>{Vec3(0.2, -0.8, 0), Vec3(0.8, -0.2, 0),
                                                       Vec3(0.8, -0.8, 0), Vec3(0.2, -0.4, 0)});
  const auto found = self_crossing(refine(curve, grid.surface), grid.mesh);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->first, 0u);
  EXPECT_EQ(found->second, 2u);
}

TEST(SelfCrossing, AtAVertexAndAtItsOwnEnd) {
  const Drawn grid{make_grid(4)};
  // Through the vertex (0, 0) twice, in faces that have but the vertex in common.
  EXPECT_TRUE(crosses(grid, grid.curve_near(std::vector<Vec3>{
                                Vec3(-0.4, -0.1, 0), Vec3(0, 0, 0), Vec3(0.4, 0.1, 0),
                                Vec3(0.1, 0.4, 0), Vec3(0, 0, 0), Vec3(-0.1, -0.4, 0)})));
  const std::vector<Vec3> ring = {Vec3(-0.4, -0.3, 0), Vec3(0.4, -0.35, 0), Vec3(0.3, 0.4, 0),
                                  Vec3(-0.4, -0.3, 0)};
  EXPECT_TRUE(crosses(grid, grid.curve_near(ring)));
  EXPECT_FALSE(crosses(grid, grid.curve_near(ring, true)));
}

TEST(SelfCrossing, SheetsCloseInSpaceDoNotCount) {
  // To the edge of a thin plate and back on its other side, below where it came.
  const Drawn plate{make_box(8, 8, 1, Vec3(1, 1, 1e-4))};
  EXPECT_FALSE(crosses(plate, plate.curve_near(std::vector<Vec3>{
                                  Vec3(-0.5, 0.1, 1e-4), Vec3(0.99, 0.1, 1e-4), Vec3(1, 0.15, 0),
                                  Vec3(0.5, 0.15, -1e-4), Vec3(0.1, -0.3, -1e-4)})));
}

TEST(SelfCrossing, EqualsAllPairsOnAPlane) {
  const Drawn grid{make_grid(6)};
  Random random(11);
  int crossing = 0;
  for (int round = 0; round < 60; ++round) {
    SCOPED_TRACE(round);
    std::vector<Vec3> points;
    Vec3 at(random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1), 0);
    double heading = random.uniform(0.0, 6.0);
    for (int i = 0; i < 21; ++i) {
      points.push_back(at);
      heading += random.uniform(-1.5, 1.5);
      at += 0.04 * Vec3(std::cos(heading), std::sin(heading), 0);
    }
    bool expected = false;
    const auto side = [](const Vec3& a, const Vec3& b, const Vec3& c) {
      return (b - a).cross(c - a).z() > 0.0;
    };
    for (std::size_t i = 0; i + 1 < points.size(); ++i)
      for (std::size_t j = i + 2; j + 1 < points.size(); ++j)
        expected = expected || (side(points[i], points[i + 1], points[j]) !=
                                    side(points[i], points[i + 1], points[j + 1]) &&
                                side(points[j], points[j + 1], points[i]) !=
                                    side(points[j], points[j + 1], points[i + 1]));
    crossing += expected ? 1 : 0;
    EXPECT_EQ(crosses(grid, grid.curve_near(points)), expected);
  }
  EXPECT_GT(crossing, 5);
  EXPECT_LT(crossing, 55);
}

}  // namespace
}  // namespace mimicry
