#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include <mimicry/base/error.h>
#include <mimicry/base/random.h>
#include <mimicry/curve/edit.h>
#include <mimicry/curve/projected_curve.h>
#include <mimicry/mesh/shapes.h>
#include <mimicry/mesh/surface.h>

#include "curve/support.h"
#include "geodesic/along.h"

namespace mimicry {
namespace {

using std::numbers::pi;
using test::Drawn;
using test::kMiddle;

double turning(const Drawn& drawn, const ProjectedCurve& curve) {
  return curvature(refine(curve, drawn.surface), drawn.surface).total_absolute_deviation;
}

bool same_bits(const ProjectedCurve& a, const ProjectedCurve& b) {
  const auto same_point = [](const CurvePoint& p, const CurvePoint& q) {
    return p.surface.face == q.surface.face && p.surface.bary == q.surface.bary &&
           p.position == q.position && p.normal == q.normal;
  };
  const auto same_crossing = [](const Crossing& c, const Crossing& d) {
    return c.half_edge == d.half_edge && c.t == d.t;
  };
  return a.closed == b.closed && a.pieces.size() == b.pieces.size() &&
         std::equal(a.points.begin(), a.points.end(), b.points.begin(), b.points.end(),
                    same_point) &&
         std::equal(a.crossings.begin(), a.crossings.end(), b.crossings.begin(), b.crossings.end(),
                    same_crossing);
}

// Around the torus, off by a random part of an edge.
ProjectedCurve noisy_ring(const Drawn& torus, bool closed) {
  Random random(11);
  std::vector<Vec3> ring;
  for (int i = 0; i < 90; ++i) {
    const double a = 2.0 * pi * i / 90;
    const double b = 0.8 + random.uniform(-0.15, 0.15);
    const double r = kTorusMajorRadius + kTorusMinorRadius * std::cos(b);
    ring.emplace_back(r * std::cos(a), r * std::sin(a), kTorusMinorRadius * std::sin(b));
  }
  if (closed) ring.push_back(ring.front());
  return torus.curve_near(ring, closed);
}

TEST(Close, JoinsTheEndsByTheShortestPath) {
  const Drawn torus{make_torus(40, 16)};
  const std::vector<SurfacePoint> ends = {{3, kMiddle}, {200, kMiddle}, {420, kMiddle}};
  ProjectedCurve curve = torus.curve(ends);
  const double open = length(curve);
  const Closing closing = close(curve, torus.surface);
  EXPECT_TRUE(closing.closed && curve.closed);
  EXPECT_EQ(closing.label, PathLabel::shortest);
  ASSERT_EQ(curve.points.size(), 4u);
  EXPECT_EQ(curve.points[3].surface.face, 3);
  EXPECT_EQ(curve.points[3].frame, curve.points[2].frame);
  const std::vector<SurfacePoint> back = {ends[2], ends[0]};
  EXPECT_EQ(length(curve), open + length(torus.curve(back)));
  // Again: nothing changes.
  const ProjectedCurve before = curve;
  EXPECT_TRUE(close(curve, torus.surface).closed);
  EXPECT_TRUE(same_bits(curve, before));
  // A curve that came back by itself needs no piece.
  curve.closed = false;
  EXPECT_TRUE(close(curve, torus.surface).closed);
  EXPECT_TRUE(same_bits(curve, before));
}

TEST(Close, LeavesACurveThatTheSurfaceDoesNotJoin) {
  const Drawn two{make_two_spheres(4)};
  const std::vector<SurfacePoint> ends = {{0, kMiddle}, {two.mesh.face_count() - 1, kMiddle}};
  for (const std::size_t count : {std::size_t{0}, std::size_t{1}, std::size_t{2}}) {
    ProjectedCurve curve = two.curve(std::span(ends).first(count));
    const ProjectedCurve before = curve;
    const Closing closing = close(curve, two.surface);
    EXPECT_FALSE(closing.closed);
    EXPECT_EQ(closing.label, PathLabel::disconnected);
    EXPECT_TRUE(same_bits(curve, before));
  }
}

TEST(Smooth, TakesTheTurnsOutOfANoisyCurve) {
  const Drawn torus{make_torus(40, 16)};
  for (const bool closed : {false, true}) {
    const ProjectedCurve noisy = noisy_ring(torus, closed);
    double before = turning(torus, noisy);
    for (const int iterations : {1, 4, 16}) {
      const ProjectedCurve smoothed = smooth(noisy, torus.surface, {0.8, iterations});
      EXPECT_LT(turning(torus, smoothed), 0.8 * before);
      before = turning(torus, smoothed);
      ASSERT_EQ(smoothed.points.size(), noisy.points.size());
      for (const CurvePoint& p : smoothed.points) {
        EXPECT_GE(p.surface.bary.minCoeff(), 0.0);
        EXPECT_NEAR(p.surface.bary.sum(), 1.0, 1e-12);
        EXPECT_EQ(p.position, torus.mesh.position(p.surface));
        EXPECT_NEAR(p.normal.norm(), 1.0, 1e-12);
      }
      const bool first_moved = smoothed.points[0].position != noisy.points[0].position;
      EXPECT_EQ(first_moved, closed);
      EXPECT_EQ(smoothed.closed, closed);
      EXPECT_EQ(smoothed.points.front().position == smoothed.points.back().position, closed);
    }
  }
}

TEST(Smooth, StrengthOneTakesAZigzagOutAtOnce) {
  const Drawn plane{make_grid(6)};
  std::vector<Vec3> zigzag;
  for (int i = 0; i <= 10; ++i) zigzag.emplace_back(-0.75 + 0.15 * i, i % 2 == 0 ? 0.1 : -0.1, 0.0);
  const ProjectedCurve smoothed = smooth(plane.curve_near(zigzag), plane.surface, {1.0, 1});
  for (std::size_t i = 1; i < 10; ++i)
    EXPECT_LT((smoothed.points[i].position - Vec3(zigzag[i].x(), 0, 0)).norm(), 1e-12);
}

TEST(Smooth, AGeodesicStays) {
  const Drawn torus{make_torus(40, 16)};
  LocalPathFinder paths(torus.surface);
  const SurfacePoint from{3, {0.2, 0.3, 0.5}};
  const SurfacePoint to{300, kMiddle};
  std::vector<Crossing> crossings;
  ASSERT_EQ(paths.find(from, to, crossings).label, PathLabel::shortest);
  std::vector<SurfacePoint> along;
  for (int i = 0; i <= 20; ++i)  // uneven
    along.push_back(
        point_along(torus.mesh, torus.edges, from, crossings, to, std::pow(i / 20.0, 1.5)));
  const ProjectedCurve curve = torus.curve(along);
  const ProjectedCurve smoothed = smooth(curve, torus.surface, {1.0, 10});
  for (std::size_t i = 0; i < along.size(); ++i)
    EXPECT_LT((smoothed.points[i].position - curve.points[i].position).norm(), 1e-10) << i;
}

TEST(Smooth, StrengthZeroChangesNothingAndGapsHoldTheirEnds) {
  const Drawn torus{make_torus(40, 16)};
  ProjectedCurve curve = noisy_ring(torus, false);
  EXPECT_TRUE(same_bits(smooth(curve, torus.surface, {0.0, 5}), curve));
  EXPECT_TRUE(same_bits(smooth(curve, torus.surface, {1.0, 0}), curve));
  curve.pieces[30].kind = PieceKind::gap;
  const ProjectedCurve smoothed = smooth(curve, torus.surface, {0.7, 3});
  EXPECT_EQ(smoothed.pieces[30].kind, PieceKind::gap);
  for (std::size_t i = 0; i < curve.points.size(); ++i) {
    const bool fixed = i == 0 || i == 30 || i == 31 || i + 1 == curve.points.size();
    EXPECT_EQ(smoothed.points[i].position == curve.points[i].position, fixed) << i;
  }
  EXPECT_THROW(smooth(curve, torus.surface, {1.1, 1}), Error);
  EXPECT_THROW(smooth(curve, torus.surface, {0.5, -1}), Error);
}

TEST(Simplify, KeepsTheCornersOfAPolyline) {
  const Drawn plane{make_grid(6)};
  std::vector<Vec3> corner;
  for (int i = 0; i <= 10; ++i) corner.emplace_back(-0.8 + 0.13 * i, -0.6, 0.0);
  for (int i = 1; i <= 10; ++i) corner.emplace_back(0.5, -0.6 + 0.11 * i, 0.0);
  const ProjectedCurve curve = plane.curve_near(corner);
  const ProjectedCurve simple = simplify(curve, plane.surface, 1e-9);
  ASSERT_EQ(simple.points.size(), 3u);
  EXPECT_EQ(simple.points[1].frame, 10);
  EXPECT_NEAR(length(simple), length(curve), 1e-12);
}

TEST(Simplify, EveryPointStaysWithinTheTolerance) {
  const Drawn torus{make_torus(40, 16)};
  for (const bool closed : {false, true})
    for (const double tolerance : {0.01, 0.03, 0.1}) {
      ProjectedCurve curve = noisy_ring(torus, closed);
      curve.pieces[50].kind = PieceKind::gap;
      const ProjectedCurve simple = simplify(curve, torus.surface, tolerance);
      EXPECT_LT(simple.points.size(), curve.points.size());
      EXPECT_EQ(simple.closed, closed);
      EXPECT_EQ(simple.points.front().position, curve.points.front().position);
      EXPECT_EQ(simple.points.back().position, curve.points.back().position);
      const auto parts = polylines(simple, torus.mesh);
      ASSERT_EQ(parts.size(), 2u);
      EXPECT_EQ(parts[0].back(), curve.points[50].position);
      EXPECT_EQ(parts[1].front(), curve.points[51].position);
      for (const CurvePoint& p : curve.points) {
        double nearest = kInfinity;
        for (const auto& part : parts)
          for (std::size_t i = 0; i + 1 < part.size(); ++i)
            for (int k = 0; k <= 400; ++k)
              nearest = std::min(
                  nearest, (part[i] + k / 400.0 * (part[i + 1] - part[i]) - p.position).norm());
        // The oracle looks at points up to 1/400 of a segment apart, 0.1 long.
        EXPECT_LT(nearest, tolerance + 2e-4);
      }
    }
}

TEST(Simplify, ALargeToleranceLeavesTheEnds) {
  const Drawn torus{make_torus(40, 16)};
  const ProjectedCurve curve = noisy_ring(torus, false);
  EXPECT_EQ(simplify(curve, torus.surface, 10.0).points.size(), 2u);
  EXPECT_EQ(simplify(curve, torus.surface, 0.0).points.size(), curve.points.size());
  EXPECT_TRUE(simplify({}, torus.surface, 1.0).points.empty());
  EXPECT_THROW(simplify(curve, torus.surface, -1.0), Error);
}

TEST(Slice, PartsMakeUpTheWhole) {
  const Drawn torus{make_torus(40, 16)};
  const ProjectedCurve ring = noisy_ring(torus, true);
  for (const std::size_t middle : {std::size_t{1}, std::size_t{20}, ring.points.size() - 2}) {
    const ProjectedCurve head = slice(ring, 0, middle + 1);
    const ProjectedCurve tail = slice(ring, middle, ring.points.size());
    EXPECT_FALSE(head.closed || tail.closed);
    EXPECT_EQ(head.points.size() + tail.points.size(), ring.points.size() + 1);
    EXPECT_EQ(head.crossings.size() + tail.crossings.size(), ring.crossings.size());
    EXPECT_NEAR(length(head) + length(tail), length(ring), 1e-12);
    const auto polyline = polylines(tail, torus.mesh);
    ASSERT_EQ(polyline.size(), 1u);
    EXPECT_EQ(polyline[0].back(), ring.points.back().position);
  }
  EXPECT_TRUE(slice(ring, 5, 6).pieces.empty());
  EXPECT_THROW(slice(ring, 5, 5), Error);
  EXPECT_THROW(slice(ring, 5, ring.points.size() + 1), Error);
}

TEST(Resampled, StepsAreEqualAndTimesLieBetween) {
  const Drawn torus{make_torus(40, 16)};
  ProjectedCurve ring = noisy_ring(torus, true);
  for (std::size_t i = 0; i < ring.points.size(); ++i) {
    ring.points[i].time_s = 0.1 * static_cast<double>(i);
    ring.points[i].frame = static_cast<Index>(i);
  }
  const ProjectedCurve even = resampled(ring, torus.surface, 1000);
  ASSERT_EQ(even.points.size(), 1000u);
  EXPECT_TRUE(even.closed);
  // Corners are cut by steps of a tenth of a piece.
  EXPECT_NEAR(length(even), length(ring), 0.02 * length(ring));
  for (std::size_t i = 1; i < even.points.size(); ++i) {
    EXPECT_LE(even.pieces[i - 1].length, length(ring) / 999 * (1 + 1e-9));
    EXPECT_GE(even.points[i].time_s, even.points[i - 1].time_s);
    EXPECT_EQ(even.points[i].frame,
              static_cast<Index>(std::floor(even.points[i].time_s / 0.1 + 1e-9)));
  }
  EXPECT_THROW(resampled(ring, torus.surface, 1), Error);

  ring.pieces[40].kind = PieceKind::gap;
  ring.pieces[40].crossing_count = 0;
  const ProjectedCurve broken = resampled(ring, torus.surface, 1000);
  EXPECT_EQ(polylines(broken, torus.mesh).size(), 2u);
}

}  // namespace
}  // namespace mimicry
