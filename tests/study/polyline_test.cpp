#include "study/polyline.h"

#include <cmath>

#include <gtest/gtest.h>

namespace mimicry {
namespace {

TEST(Polyline, ResamplingIsEvenInLengthAndKeepsTheEnds) {
  const std::vector<Vec3> bent = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 0, 0), Vec3(1, 3, 0)};
  const auto even = resample(bent, 9);
  ASSERT_EQ(even.size(), 9u);
  EXPECT_EQ(even.front(), bent.front());
  EXPECT_EQ(even.back(), bent.back());
  EXPECT_LT((even[1] - Vec3(0.5, 0, 0)).norm(), 1e-15);
  EXPECT_LT((even[4] - Vec3(1, 1, 0)).norm(), 1e-15);
}

TEST(Polyline, WithoutLengthOrPointsNothingBreaks) {
  EXPECT_TRUE(resample({}, 5).empty());
  const std::vector<Vec3> point(3, Vec3(1, 2, 3));
  for (const Vec3& x : resample(point, 5)) EXPECT_EQ(x, Vec3(1, 2, 3));
  EXPECT_TRUE(std::isnan(mean_corresponding_distance({}, point)));
}

TEST(Polyline, DistanceOfATranslatedCopyIsTheTranslation) {
  std::vector<Vec3> circle, moved;
  for (int i = 0; i <= 200; ++i) {
    circle.emplace_back(std::cos(0.03 * i), std::sin(0.03 * i), 0.0);
    moved.push_back(circle.back() + Vec3(0.0, 0.3, 0.4));
  }
  EXPECT_NEAR(mean_corresponding_distance(moved, circle), 0.5, 1e-12);
}

}  // namespace
}  // namespace mimicry
