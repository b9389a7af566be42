#include <cmath>

#include <gtest/gtest.h>

#include <mimicry/base/random.h>
#include <mimicry/curve/projected_curve.h>
#include <mimicry/mesh/shapes.h>

#include "curve/support.h"
#include "geodesic/site.h"

namespace mimicry {
namespace {

using test::Drawn;
using test::kMiddle;

TEST(Refine, EverySegmentLiesInTheFaceThatIsNamed) {
  const Drawn torus{make_torus(24, 10)};
  Random random(5);
  std::vector<SurfacePoint> points;
  for (int i = 0; i < 60; ++i) {
    SurfacePoint p{static_cast<Index>(random.below(480)), kMiddle};
    const auto k = static_cast<int>(random.below(3));
    if (i % 3 == 1) p.bary = Vec3::Unit(k);                   // a vertex
    if (i % 3 == 2) p.bary[k] = 0.0, p.bary /= p.bary.sum();  // an edge
    points.push_back(p);
  }
  const ProjectedCurve curve = torus.curve(points);
  const RefinedCurve refined = refine(curve, torus.surface);
  ASSERT_EQ(refined.parts.size(), 1u);
  ASSERT_EQ(refined.point_nodes.size(), points.size());
  // A torus of this size has lengths of some units, and there are some hundred segments to add.
  EXPECT_NEAR(refined.nodes.back().length, length(curve), 1e-12);
  for (std::size_t i = 0; i + 1 < refined.nodes.size(); ++i) {
    for (const std::size_t k : {i, i + 1}) {
      const SurfacePoint p = in_face(torus.mesh, refined.nodes[k].point, refined.faces[i]);
      EXPECT_LT((torus.mesh.position(p) - refined.nodes[k].position).norm(), 1e-14);
    }
  }
  for (std::size_t i = 0; i < points.size(); ++i)
    EXPECT_LT((refined.nodes[refined.point_nodes[i]].position - curve.points[i].position).norm(),
              1e-14);
}

TEST(Refine, PointsABreathBesideAnEdgeOrVertexAreOneNodeWithIt) {
  const Drawn plane{make_grid(2)};
  const SurfacePoint start = plane.locate({-0.7, 0.11, 0});
  const SurfacePoint end = plane.locate({0.6, -0.17, 0});
  const std::vector<SurfacePoint> bare = {start, end};
  const RefinedCurve expected = refine(plane.curve(bare), plane.surface);
  for (std::size_t i = 1; i + 1 < expected.nodes.size(); ++i)
    for (const double off : {0.0, 1e-13, 1e-10, 9e-8}) {
      // Beside the crossing, in both its faces.
      for (const Index face : {expected.faces[i - 1], expected.faces[i]}) {
        SurfacePoint p = in_face(plane.mesh, expected.nodes[i].point, face);
        for (int k = 0; k < 3; ++k)
          if (p.bary[k] == 0.0) p.bary[k] = off;
        p.bary /= p.bary.sum();
        const std::vector<SurfacePoint> points = {start, p, p, end};
        const RefinedCurve refined = refine(plane.curve(points), plane.surface);
        EXPECT_EQ(refined.nodes.size(), expected.nodes.size()) << off;
        EXPECT_EQ(refined.point_nodes[1], i);
        EXPECT_EQ(refined.point_nodes[2], i);
      }
    }
}

TEST(Refine, GapsAndChordsPartTheCurve) {
  const Drawn two{make_two_spheres(4)};
  CurveBuilder builder(two.surface);
  const Index last = two.mesh.face_count() - 1;
  builder.append(two.point({0, kMiddle}));
  builder.append(two.point({5, kMiddle}));
  builder.append(two.point({last, kMiddle}));  // a chord
  builder.append(two.point({last - 9, kMiddle}));
  builder.break_here();
  builder.append(two.point({last - 20, kMiddle}));
  const RefinedCurve refined = refine(builder.curve(), two.surface);
  ASSERT_EQ(refined.parts.size(), 3u);
  EXPECT_EQ(refined.parts[1], refined.point_nodes[2]);
  EXPECT_EQ(refined.parts[2], refined.point_nodes[4]);
  EXPECT_EQ(refined.faces[refined.parts[1] - 1], kNone);
  EXPECT_EQ(refined.nodes[refined.parts[1]].length, refined.nodes[refined.parts[1] - 1].length);
  EXPECT_NEAR(refined.nodes.back().length,
              builder.curve().pieces[0].length + builder.curve().pieces[2].length, 1e-13);
}

TEST(Refine, EmptyAndSingle) {
  const Drawn sphere{make_sphere(2)};
  EXPECT_TRUE(refine({}, sphere.surface).nodes.empty());
  const std::vector<SurfacePoint> one = {{3, kMiddle}};
  EXPECT_EQ(refine(sphere.curve(one), sphere.surface).nodes.size(), 1u);
}

}  // namespace
}  // namespace mimicry
