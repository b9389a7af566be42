#include "embedding/spline.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "bench/edge_turns.h"
#include "embedding/baked.h"

namespace mimicry {
namespace {

TEST(Spline, OnAPlaneIsThePlanesSpline) {
  const Baked& grid = *shapes()[3];
  std::vector<SurfacePoint> controls;
  for (const Vec2& p :
       {Vec2(-0.5, -0.4), Vec2(-0.2, 0.3), Vec2(0.1, -0.2), Vec2(0.5, 0.4), Vec2(0.6, -0.3)})
    controls.push_back(grid.target.closest_point(Vec3(p[0], p[1], 0.0))->surface);
  const auto at = [&](std::size_t i) { return grid.target.position(controls[i]); };
  // Where two spans meet: a sixth, four sixths, a sixth.
  const SmoothPoint joint = b_spline_point(grid.projector, controls, 1.0);
  // The scaling of the embedding's distances leaves a grid flat but for its quality.
  EXPECT_LT((joint.position - (at(1) + 4.0 * at(2) + at(3)) / 6.0).norm(), 0.02);
}

// Controls about a fifth of the shape apart.
std::vector<SurfacePoint> winding_controls(const Target& target) {
  std::vector<SurfacePoint> controls;
  for (int i = 0; i < 7; ++i) {
    const double a = 0.35 * i;
    controls.push_back(
        target.closest_point(Vec3(std::cos(a), std::sin(a), 0.2 * std::sin(2.0 * a)))->surface);
  }
  return controls;
}

TEST(Spline, IsSmoothOnTheSurface) {
  for (const Baked* shape : {shapes()[0].get(), shapes()[1].get()}) {
    const std::vector<SurfacePoint> controls = winding_controls(shape->target);
    double coarse = 0.0, fine = 0.0;  // largest angle between consecutive steps
    for (const Index points : {200, 800}) {
      const auto curve = b_spline_curve(shape->projector, controls, points);
      double& worst = points == 200 ? coarse : fine;
      for (std::size_t i = 2; i < curve.size(); ++i) {
        EXPECT_EQ(curve[i].label, ScpLabel::smooth);
        const Vec3 a = curve[i - 1].position - curve[i - 2].position;
        const Vec3 b = curve[i].position - curve[i - 1].position;
        worst = std::max(worst, std::atan2(a.cross(b).norm(), a.dot(b)));
      }
    }
    // What is left of the angle is the surface's own: edges between facets, bent by 10 degrees on
    // the sphere.
    EXPECT_LT(fine, 0.35) << shape->name;
    EXPECT_LT(fine, 1.2 * coarse) << shape->name;
  }
}

TEST(Spline, TurnsSmoothlyWithinFaces) {
  for (const Baked* shape : {shapes()[0].get(), shapes()[1].get()}) {
    const std::vector<SurfacePoint> controls = winding_controls(shape->target);
    const auto turn = [&](Index points) {
      const auto curve = b_spline_curve(shape->projector, controls, points);
      double worst = 0.0;
      for (std::size_t i = 2; i < curve.size(); ++i) {
        const Index f = curve[i].surface.face;
        if (curve[i - 2].surface.face != f || curve[i - 1].surface.face != f) continue;
        const Vec3 before = curve[i - 1].position - curve[i - 2].position;
        const Vec3 after = curve[i].position - curve[i - 1].position;
        worst = std::max(worst, std::atan2(before.cross(after).norm(), before.dot(after)));
      }
      return worst;
    };
    // Where spans meet, too: a corner would keep its angle.
    EXPECT_LT(turn(6400), 0.5 * turn(800)) << shape->name;
  }
}

TEST(Spline, TurnsAcrossEdgesVanishAsTheMeshGetsFiner) {
  if (test::kSanitized) GTEST_SKIP() << "a measurement of large bakes; nothing else runs in it";
  for (const bool is_sphere : {true, false}) {
    const auto turns = [&](int n) {
      return bench::edge_turns(
          Baked("", is_sphere ? make_sphere(n) : make_torus(4 * n, 2 * n)).projector);
    };
    const bench::EdgeTurns coarse = turns(6), fine = turns(18);
    // Where the embedding's metric is smooth, both fall; a rough one keeps those in space as they
    // are at any fineness. Edges are a third as long.
    EXPECT_LT(fine.in_embedding, 0.5 * coarse.in_embedding);
    EXPECT_LT(fine.in_space, 0.75 * coarse.in_space);
  }
}

}  // namespace
}  // namespace mimicry
