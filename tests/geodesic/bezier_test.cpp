#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include <mimicry/base/error.h>
#include <mimicry/geodesic/paths.h>
#include <mimicry/mesh/shapes.h>

#include "geodesic/along.h"
#include "geodesic/support.h"

namespace mimicry {
namespace {

const Vec3 kMiddle = Vec3::Constant(1.0 / 3.0);

Vec3 slerp(const Vec3& a, const Vec3& b, double t) {
  const double angle = std::atan2(a.cross(b).norm(), a.dot(b));
  if (angle == 0.0) return a;
  return (std::sin((1 - t) * angle) * a + std::sin(t * angle) * b) / std::sin(angle);
}

TEST(PointAlong, DividesAPathByLength) {
  const TriangleMesh plane = make_grid(5);
  const Surface surface = Surface::as_given(plane);
  const HalfEdges& edges = surface.half_edges();
  LocalPathFinder paths(surface);
  const SurfacePoint from{2, {0.2, 0.3, 0.5}};
  const SurfacePoint to{47, kMiddle};
  std::vector<Crossing> crossings;
  ASSERT_EQ(paths.find(from, to, crossings).label, PathLabel::shortest);
  ASSERT_GT(crossings.size(), 3u);
  for (int i = 0; i <= 10; ++i) {
    const double t = i / 10.0;
    const Vec3 expected = (1 - t) * plane.position(from) + t * plane.position(to);
    const SurfacePoint p = point_along(plane, edges, from, crossings, to, t);
    EXPECT_LT((plane.position(p) - expected).norm(), 1e-14);
  }
  EXPECT_EQ(point_along(plane, edges, from, crossings, to, 0.0).bary, from.bary);
  EXPECT_EQ(point_along(plane, edges, from, crossings, to, 1.0).bary, to.bary);
}

TEST(Bezier, OnAPlaneItIsThePlanarOne) {
  const TriangleMesh plane = make_grid(8);
  const Surface surface = Surface::as_given(plane);
  const std::vector<SurfacePoint> controls = {
      {3, kMiddle}, {70, {1, 0, 0}}, {120, {0.5, 0.5, 0}}, {17, {0.1, 0.2, 0.7}}};
  const BezierCurve curve = bezier(surface, controls, 41);
  ASSERT_TRUE(curve.connected && curve.all_shortest);
  ASSERT_EQ(curve.points.size(), 41u);
  EXPECT_EQ(curve.points.front().bary, controls.front().bary);
  EXPECT_EQ(curve.points.back().bary, controls.back().bary);
  for (int i = 0; i <= 40; ++i) {
    const double t = i / 40.0;
    const double s = 1 - t;
    const Vec3 expected =
        s * s * s * plane.position(controls[0]) + 3 * s * s * t * plane.position(controls[1]) +
        3 * s * t * t * plane.position(controls[2]) + t * t * t * plane.position(controls[3]);
    EXPECT_LT((plane.position(curve.points[static_cast<std::size_t>(i)]) - expected).norm(), 1e-13);
  }
}

TEST(Bezier, OnASphereItFollowsGreatCirclesAndIsTheSameFromTheOtherEnd) {
  const TriangleMesh sphere = make_sphere(20);
  const Surface surface = Surface::as_given(sphere);
  std::vector<SurfacePoint> controls = {{10, kMiddle}, {700, kMiddle}, {1500, {0.6, 0.2, 0.2}}};
  const BezierCurve curve = bezier(surface, controls, 21);
  std::reverse(controls.begin(), controls.end());
  const BezierCurve reversed = bezier(surface, controls, 21);
  ASSERT_EQ(curve.points.size(), 21u);
  std::vector<Vec3> at;
  for (const SurfacePoint& p : controls) at.push_back(sphere.position(p).normalized());
  for (std::size_t i = 0; i < 21; ++i) {
    const Vec3 p = sphere.position(curve.points[i]);
    EXPECT_LT((p - sphere.position(reversed.points[20 - i])).norm(), 1e-10);
    const double t = 1.0 - static_cast<double>(i) / 20.0;
    const Vec3 expected = slerp(slerp(at[0], at[1], t), slerp(at[1], at[2], t), t);
    // Edges are 0.06 long; a geodesic may pass a vertex on the other side, a fraction of that.
    EXPECT_LT((p - expected).norm(), 0.02) << i;
  }
}

TEST(Bezier, DisconnectedControlPointsAreAResultAndBadOnesAnError) {
  const TriangleMesh two = make_two_spheres(4);
  const Surface surface = Surface::as_given(two);
  const std::vector<SurfacePoint> apart = {{0, kMiddle}, {two.face_count() - 1, kMiddle}};
  const BezierCurve curve = bezier(surface, apart, 5);
  EXPECT_FALSE(curve.connected);
  EXPECT_TRUE(curve.points.empty());
  const std::vector<SurfacePoint> one = {{7, kMiddle}};
  EXPECT_EQ(bezier(surface, one, 3).points.size(), 3u);
  EXPECT_THROW(bezier(surface, {}, 3), Error);
  EXPECT_THROW(bezier(surface, one, 1), Error);
  const std::vector<SurfacePoint> off = {{7, kMiddle}, {two.face_count(), kMiddle}};
  EXPECT_THROW(bezier(surface, off, 3), Error);
}

}  // namespace
}  // namespace mimicry
