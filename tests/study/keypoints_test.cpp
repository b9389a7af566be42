#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include <mimicry/base/error.h>
#include <mimicry/mesh/shapes.h>
#include <mimicry/spatial/target.h>
#include <mimicry/study/targets.h>

namespace mimicry {
namespace {

std::vector<SurfacePoint> on_grid(const Target& grid, std::span<const Vec2> places) {
  std::vector<SurfacePoint> points;
  for (const Vec2& p : places) points.push_back(grid.closest_point(Vec3(p[0], p[1], 0))->surface);
  return points;
}

// An L whose corner, rounded with radius 0.1, has its middle at point 60 of 120.
std::vector<Vec2> bent() {
  std::vector<Vec2> places;
  for (int i = 0; i < 50; ++i) places.push_back(Vec2(-0.8 + 0.016 * i, 0.0));
  for (int i = 0; i <= 20; ++i) {
    const double a = std::numbers::pi / 2.0 * i / 20.0;
    places.push_back(Vec2(0.1 * std::sin(a), 0.1 - 0.1 * std::cos(a)));
  }
  for (int i = 1; i <= 50; ++i) places.push_back(Vec2(0.1, 0.1 + 0.016 * i));
  return places;
}

TEST(Keypoints, AreTheEndsAndTheBend) {
  const Target grid(make_grid(16));
  // 1.76 units: at 0.15 m a unit the halves are 13 cm, below 15.
  const auto found = keypoints(grid.surface(), on_grid(grid, bent()), 0.15);
  EXPECT_EQ(found.front(), 0);
  EXPECT_EQ(found.back(), 120);
  ASSERT_EQ(found.size(), 3u);
  // Somewhere on the arc, whose curvature is constant.
  EXPECT_NEAR(found[1], 60, 8);
}

TEST(Keypoints, LongSectionsAreDividedEvenly) {
  const Target grid(make_grid(16));
  std::vector<Vec2> line;
  for (int i = 0; i <= 100; ++i) line.push_back(Vec2(-0.5 + 0.01 * i, 0.2));
  const auto points = on_grid(grid, line);
  using Numbers = std::vector<Index>;
  const auto at = [&](double scale) { return keypoints(grid.surface(), points, scale); };
  EXPECT_EQ(at(0.149), (Numbers{0, 100}));
  EXPECT_EQ(at(0.15), (Numbers{0, 100}));
  EXPECT_EQ(at(0.16), (Numbers{0, 50, 100}));
  EXPECT_EQ(at(0.59), (Numbers{0, 25, 50, 75, 100}));
}

TEST(Keypoints, KeepTheirDistance) {
  const Target grid(make_grid(16));
  std::vector<Vec2> zigzag;  // a bend every 0.05 units
  for (int i = 0; i <= 300; ++i)
    zigzag.push_back(Vec2(-0.6 + 0.004 * i, 0.02 * std::sin(i * 0.004 / 0.05 * std::numbers::pi)));
  const auto points = on_grid(grid, zigzag);
  const double scale = 0.1;
  const auto found = keypoints(grid.surface(), points, scale);
  for (std::size_t k = 1; k < found.size(); ++k) {
    const Vec3 a = grid.position(points[static_cast<std::size_t>(found[k - 1])]);
    const Vec3 b = grid.position(points[static_cast<std::size_t>(found[k])]);
    // Straight through space, which the waves are at most 1.2 times as long as.
    EXPECT_GT(scale * (b - a).norm(), 0.03 / 1.5);
  }
  EXPECT_GE(found.size(), 3u);
}

TEST(Keypoints, OfAlmostNothing) {
  const Target grid(make_grid(4));
  const auto one = on_grid(grid, std::vector<Vec2>{Vec2(0.1, 0.1)});
  EXPECT_TRUE(keypoints(grid.surface(), {}, 1.0).empty());
  EXPECT_EQ(keypoints(grid.surface(), one, 1.0), std::vector<Index>{0});
  const std::vector<SurfacePoint> twice = {one[0], one[0]};
  EXPECT_EQ(keypoints(grid.surface(), twice, 1.0), (std::vector<Index>{0, 1}));
  EXPECT_THROW(keypoints(grid.surface(), twice, 0.0), Error);
  EXPECT_THROW(keypoints(grid.surface(), twice, 1.0, {.window = 0.0}), Error);
}

}  // namespace
}  // namespace mimicry
