#include <cmath>

#include <gtest/gtest.h>

#include <mimicry/curve/projected_curve.h>
#include <mimicry/mesh/shapes.h>

#include "curve/support.h"

namespace mimicry {
namespace {

using test::Drawn;
using test::kMiddle;

TEST(Sample, OnAPlaneTheStepsAreEvenAndTheEndsExact) {
  const Drawn plane{make_grid(9)};
  const Vec3 ends[] = {{-0.83, -0.71, 0}, {0.77, 0.64, 0}};
  const ProjectedCurve curve = plane.curve_near(ends);
  const auto points = resample(curve, plane.surface, 101);
  ASSERT_EQ(points.size(), 101u);
  EXPECT_EQ(points.front().bary, curve.points.front().surface.bary);
  EXPECT_EQ(points.back().bary, curve.points.back().surface.bary);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double t = static_cast<double>(i) / 100;
    const Vec3 expected =
        (1 - t) * curve.points.front().position + t * curve.points.back().position;
    EXPECT_LT((plane.mesh.position(points[i]) - expected).norm(), 1e-13);
  }
}

TEST(Sample, EveryPointLiesAtItsLengthAlongTheCurve) {
  const Drawn torus{make_torus(30, 12)};
  std::vector<SurfacePoint> along;
  for (Index f = 0; f < 300; f += 23) along.push_back({f, kMiddle});
  const ProjectedCurve curve = torus.curve(along);
  // The oracle walks the polyline.
  const auto polyline = polylines(curve, torus.mesh)[0];
  const double total = length(curve);
  for (int i = 0; i <= 77; ++i) {
    const double s = total * i / 77;
    const Vec3 sampled = torus.mesh.position(point_at_length(curve, torus.surface, s));
    double left = s;
    std::size_t k = 0;
    while (k + 2 < polyline.size() && (polyline[k + 1] - polyline[k]).norm() < left)
      left -= (polyline[k + 1] - polyline[k]).norm(), ++k;
    const Vec3 expected = polyline[k] + left * (polyline[k + 1] - polyline[k]).normalized();
    EXPECT_LT((sampled - expected).norm(), 1e-12) << i;
  }
  EXPECT_EQ(point_at_length(curve, torus.surface, -1.0).face, along.front().face);
  EXPECT_EQ(point_at_length(curve, torus.surface, 2 * total).face, along.back().face);
}

TEST(Sample, GapsAreSteppedOver) {
  const Drawn plane{make_grid(4)};
  CurveBuilder builder(plane.surface);
  builder.append(plane.point(plane.locate({-0.9, 0, 0})));
  builder.append(plane.point(plane.locate({-0.5, 0, 0})));
  builder.break_here();
  builder.append(plane.point(plane.locate({0.5, 0, 0})));
  builder.append(plane.point(plane.locate({0.9, 0, 0})));
  const auto points = resample(builder.curve(), plane.surface, 6);
  const double expected[] = {-0.9, -0.74, -0.58, 0.58, 0.74, 0.9};
  for (std::size_t i = 0; i < 6; ++i)
    EXPECT_NEAR(plane.mesh.position(points[i]).x(), expected[i], 1e-13);
}

TEST(Sample, CurvesWithoutLength) {
  const Drawn sphere{make_sphere(2)};
  EXPECT_TRUE(resample({}, sphere.surface, 5).empty());
  const std::vector<SurfacePoint> one = {{3, kMiddle}};
  EXPECT_TRUE(resample(sphere.curve(one), sphere.surface, 0).empty());
  const auto points = resample(sphere.curve(one), sphere.surface, 3);
  ASSERT_EQ(points.size(), 3u);
  for (const SurfacePoint& p : points) EXPECT_EQ(p.face, 3);
}

}  // namespace
}  // namespace mimicry
