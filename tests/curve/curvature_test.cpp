#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include <mimicry/base/random.h>
#include <mimicry/curve/projected_curve.h>
#include <mimicry/geodesic/paths.h>
#include <mimicry/mesh/shapes.h>

#include "curve/support.h"
#include "geodesic/site.h"

namespace mimicry {
namespace {

using std::numbers::pi;
using test::Drawn;
using test::kMiddle;

CurveCurvature measure(const Drawn& drawn, const ProjectedCurve& curve) {
  return curvature(refine(curve, drawn.surface), drawn.surface);
}

ProjectedCurve traced(const Drawn& drawn, const SurfacePoint& from, const Vec3& direction,
                      double length) {
  ProjectedCurve curve;
  const Trace trace = trace_straightest(drawn.surface, from, direction, length, &curve.crossings);
  EXPECT_EQ(trace.stop, TraceStop::complete);
  curve.points = {drawn.point(from), drawn.point(trace.end)};
  curve.pieces = {{PieceKind::locally_shortest, trace.length, 0,
                   static_cast<std::uint32_t>(curve.crossings.size())}};
  return curve;
}

TEST(Curvature, AStraightestGeodesicDoesNotDeviate) {
  const Drawn torus{make_torus(48, 20)};
  for (Index f = 0; f < torus.mesh.face_count(); f += 61) {
    const Vec3 direction = torus.mesh.corner(f, 1) - torus.mesh.position({f, {0.1, 0.3, 0.6}});
    const auto measured = measure(torus, traced(torus, {f, {0.4, 0.35, 0.25}}, direction, 2.0));
    EXPECT_GT(measured.uses.size(), 20u);
    // Some 50 nodes; segments shorter than 1e-5 cost the angle some digits.
    EXPECT_LT(measured.total_absolute_deviation, 1e-9) << f;
    EXPECT_GT(measured.total_turning, 1.0);
  }
}

TEST(Curvature, AStraightestGeodesicThroughACornerHasEqualAnglesOnBothSides) {
  const Drawn cube{make_box(2, 2, 2, Vec3::Constant(0.8))};
  const SurfacePoint from = cube.locate({0.8, 0.3, 0.55});
  const Vec3 direction = Vec3::Constant(0.8) - cube.mesh.position(from);
  const auto measured = measure(cube, traced(cube, from, direction, 1.0));
  EXPECT_LT(measured.total_absolute_deviation, 1e-12);
  EXPECT_GT(measured.total_turning, 0.5);
}

TEST(Curvature, SignAndSizeAtACornerOfACube) {
  const Drawn cube{make_box(1, 1, 1, Vec3::Constant(0.8))};
  const Vec3 corner = Vec3::Constant(0.8);
  const Vec3 before = corner - Vec3(0.5, 0, 0);
  const Vec3 after = corner - Vec3(0, 0.5, 0);
  // Along two edges of the top: a quarter on one side, two on the other, of three.
  const Vec3 to_the_right[] = {before, corner, after};
  const auto right = measure(cube, cube.curve_near(to_the_right));
  ASSERT_EQ(right.uses.size(), 3u);
  EXPECT_NEAR(right.total_deviation, -pi / 4, 1e-12);
  EXPECT_NEAR(right.total_normalised, -pi / 3, 1e-12);
  EXPECT_NEAR(right.total_turning, pi / 2, 1e-12);
  const Vec3 to_the_left[] = {after, corner, before};
  EXPECT_NEAR(measure(cube, cube.curve_near(to_the_left)).total_deviation, pi / 4, 1e-12);
}

TEST(Curvature, APolygonInThePlaneTurnsOnce) {
  const Drawn plane{make_grid(7)};
  std::vector<Vec3> polygon;
  for (int i = 0; i <= 9; ++i) {
    const double a = 2.0 * pi * (i % 9) / 9;
    const double r = i % 9 % 2 == 1 ? 0.4 : 0.9;
    polygon.emplace_back(r * std::cos(a), r * std::sin(a), 0.0);
  }
  const auto left = measure(plane, plane.curve_near(polygon, true));
  EXPECT_NEAR(left.total_deviation, 2.0 * pi, 1e-11);
  EXPECT_NEAR(left.total_normalised, 2.0 * pi, 1e-11);
  // In the plane the angle in space is the deviation.
  EXPECT_NEAR(left.total_absolute_deviation, left.total_turning, 1e-7);
  EXPECT_GT(left.total_turning, 7.0);
  std::reverse(polygon.begin(), polygon.end());
  EXPECT_NEAR(measure(plane, plane.curve_near(polygon, true)).total_deviation, -2.0 * pi, 1e-11);
  // Open, the joint does not count.
  EXPECT_GT(std::abs(measure(plane, plane.curve_near(polygon)).total_deviation + 2.0 * pi), 0.1);
}

TEST(Curvature, AroundACornerOfACubeTheAngleDefectIsMissing) {
  const Drawn cube{make_box(3, 3, 3, Vec3::Constant(0.8))};
  const Vec3 around[] = {
      {0.8, 0.31, 0.42}, {0.38, 0.8, 0.33}, {0.35, 0.41, 0.8}, {0.8, 0.31, 0.42}};
  const auto measured = measure(cube, cube.curve_near(around, true));
  EXPECT_NEAR(measured.total_deviation, 2.0 * pi - pi / 2, 1e-11);
}

TEST(Curvature, ACircleOfLatitudeHasItsGeodesicCurvature) {
  const Drawn sphere{make_sphere(20)};
  for (const double colatitude : {0.5, 1.0, 1.4}) {
    std::vector<Vec3> circle;
    for (int i = 0; i <= 150; ++i) {
      const double a = 2.0 * pi * (i % 150) / 150;
      circle.emplace_back(std::sin(colatitude) * std::cos(a), std::sin(colatitude) * std::sin(a),
                          std::cos(colatitude));
    }
    const auto measured = measure(sphere, sphere.curve_near(circle, true));
    // All curvature sits in 4,002 vertices, 4 pi / 4,002 = 0.003 each; along the circle some 80 lie
    // within half an edge, each counted or not: half of them on one side would be 0.06.
    EXPECT_NEAR(measured.total_deviation, 2.0 * pi * std::cos(colatitude), 0.06) << colatitude;
  }
}

TEST(Curvature, ShortestPathsOnRoughSurfacesDeviateAtTheirEndsAndVerticesOnly) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    SCOPED_TRACE(seed);
    const Drawn rough{make_noisy_cube(10, 0.2, true, seed)};
    Random random(seed);
    std::vector<SurfacePoint> points;
    for (int i = 0; i < 150; ++i) {
      SurfacePoint p{static_cast<Index>(random.below(1200)), {0.2, 0.3, 0.5}};
      const auto k = static_cast<int>(random.below(3));
      if (i % 3 == 1) p.bary = Vec3::Unit(k);                   // a vertex
      if (i % 3 == 2) p.bary[k] = 0.0, p.bary /= p.bary.sum();  // an edge
      points.push_back(p);
    }
    const RefinedCurve refined = refine(rough.curve(points), rough.surface);
    const auto measured = curvature(refined, rough.surface);
    ASSERT_EQ(refined.parts.size(), 1u);
    EXPECT_EQ(measured.undefined_nodes, 0u);
    std::vector<bool> is_point(refined.nodes.size(), false);
    for (const std::size_t i : refined.point_nodes) is_point[i] = true;
    int edges = 0;
    for (std::size_t i = 1; i + 1 < refined.nodes.size(); ++i) {
      const auto& node = refined.nodes;
      const double shortest =
          std::min(node[i].length - node[i - 1].length, node[i + 1].length - node[i].length);
      // Snapping moves an end by 1e-7 of an edge at most.
      const double moved = 1e-7 / shortest;
      if (is_point[i] || moved > 1e-3) continue;
      if (site_of(rough.mesh, node[i].point).kind == Site::Kind::edge) {
        EXPECT_LT(std::abs(measured.deviation[i]), 4.0 * moved + 1e-12);
        ++edges;
      } else {  // a saddle: pi or more on both sides
        const double half = pi * measured.deviation[i] /
                            (measured.normalised[i] == 0.0 ? 1 : measured.normalised[i]);
        EXPECT_LE(std::abs(measured.deviation[i]), std::max(0.0, half - pi) + 1e-6);
      }
    }
    EXPECT_GT(edges, 1000);
  }
}

TEST(Curvature, BoundaryVerticesAreSkippedAndCounted) {
  const Drawn plane{make_grid(1)};
  const Vec3 along[] = {{0.2, 0.9, 0}, {1, 1, 0}, {0.9, 0.3, 0}};
  const auto measured = measure(plane, plane.curve_near(along));
  EXPECT_EQ(measured.boundary_nodes, 1u);
  EXPECT_EQ(measured.total_absolute_deviation, 0.0);
  EXPECT_GT(measured.total_turning, 1.0);
}

}  // namespace
}  // namespace mimicry
