#include "phong/triangle8.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include <mimicry/base/random.h>

namespace mimicry {
namespace {

Vec8 random_vec8(Random& random) {
  Vec8 x;
  for (int k = 0; k < kDimension; ++k) x[k] = random.normal();
  return x;
}

// The nearest point by its definition: that of the plane, or of one of the sides.
double squared_distance(const std::array<Vec8, 3>& x, const Vec8& y) {
  double best = kInfinity;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec8 &a = x[i], side = x[(i + 1) % 3] - a;
    const double length2 = side.squaredNorm();
    const double h =
        length2 > 0.0 ? std::min(std::max((y - a).dot(side) / length2, 0.0), 1.0) : 0.0;
    best = std::min(best, (y - a - h * side).squaredNorm());
  }
  Eigen::Matrix<double, kDimension, 2> sides;
  sides << x[1] - x[0], x[2] - x[0];
  const Eigen::Matrix2d gram = sides.transpose() * sides;
  if (gram.determinant() > 1e-9 * gram.squaredNorm()) {
    const Vec2 b = gram.inverse() * (sides.transpose() * (y - x[0]));
    if (b[0] >= 0.0 && b[1] >= 0.0 && b.sum() <= 1.0)
      best = std::min(best, (y - x[0] - sides * b).squaredNorm());
  }
  return best;
}

// Triangles of a scaled and shifted content, some thin, some without area, some single points.
std::array<Vec8, 3> random_triangle(Random& random, int kind) {
  std::array<Vec8, 3> x;
  const Vec8 where = 0.2 * random_vec8(random);
  const double size = std::pow(10.0, random.uniform(-4.0, -1.0));
  for (Vec8& corner : x) corner = where + size * random_vec8(random);
  if (kind == 1) x[2] = x[0] + random.uniform() * (x[1] - x[0]) + 1e-9 * size * random_vec8(random);
  if (kind == 2) x[2] = x[0] + random.uniform(-1.0, 2.0) * (x[1] - x[0]);
  if (kind == 3) x[1] = x[0];
  if (kind == 4) x[1] = x[2] = x[0];
  return x;
}

TEST(Triangle8Pack, DropsOnlyWhatIsFarther) {
  for (const double scale : {1.0, 1e-30, 1e30}) {
    Random random(3);
    for (int trial = 0; trial < 4000; ++trial) {
      std::array<std::array<Vec8, 3>, 4> x;
      Triangle8::Pack pack;
      for (std::size_t lane = 0; lane < 4; ++lane) {
        x[lane] = random_triangle(random, static_cast<int>(random.below(5)));
        for (Vec8& corner : x[lane]) corner *= scale;
        pack.set(static_cast<int>(lane), {{&x[lane][0], &x[lane][1], &x[lane][2]}});
      }
      // Near one of them, or on it.
      const auto& near = x[random.below(4)];
      const double size = (near[1] - near[0]).norm() + 1e-4 * scale;
      Vec8 y =
          near[0] + random.uniform() * (near[1] - near[0]) + random.uniform() * (near[2] - near[0]);
      if (trial % 3 != 0) y += random.uniform() * size * random_vec8(random);
      const double bound = trial % 5 == 0 ? 0.0 : random.uniform(0.0, 2.0) * size;
      Triangle8::Pack::NearSieve sieve(y, 1.0 / scale);
      sieve.set_bound(static_cast<float>(bound * bound / (scale * scale) * (1.0 + 1e-7)));
      const unsigned kept = pack.candidates(sieve);
      for (std::size_t lane = 0; lane < 4; ++lane) {
        const double distance = std::sqrt(squared_distance(x[lane], y) / (scale * scale));
        if (distance > bound / scale) continue;
        EXPECT_TRUE(kept >> lane & 1U)
            << "scale " << scale << ", trial " << trial << ", lane " << lane;
      }
    }
  }
}

// What floats tell apart is dropped.
TEST(Triangle8Pack, KeepsLittleThatIsFarther) {
  Random random(4);
  int dropped = 0, farther = 0;
  for (int trial = 0; trial < 4000; ++trial) {
    std::array<Vec8, 3> x = random_triangle(random, 0);
    Triangle8::Pack pack;
    for (int lane = 0; lane < 4; ++lane) pack.set(lane, {{&x[0], &x[1], &x[2]}});
    const double size = (x[1] - x[0]).norm();
    const Vec8 y = x[0] + size * random_vec8(random);
    const double distance2 = squared_distance(x, y);
    Triangle8::Pack::NearSieve sieve(y, 1.0);
    sieve.set_bound(static_cast<float>(0.999 * distance2));
    ++farther;
    if (pack.candidates(sieve) == 0) ++dropped;
  }
  EXPECT_GT(dropped, 0.99 * farther);
}

}  // namespace
}  // namespace mimicry
