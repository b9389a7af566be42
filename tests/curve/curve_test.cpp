#include <cmath>

#include <gtest/gtest.h>

#include <mimicry/mesh/shapes.h>

#include "curve/curve_builder.h"
#include "curve/support.h"

namespace mimicry {
namespace {

using test::Drawn;
using test::kMiddle;

TEST(Curve, EveryPieceRunsFromPointToPointAcrossNeighbouringFaces) {
  const Drawn sphere{make_sphere(8)};
  CurveBuilder builder(sphere.surface);
  for (Index f = 0; f < sphere.mesh.face_count(); f += 37)
    builder.append(sphere.point({f, kMiddle}));
  const ProjectedCurve& curve = builder.curve();
  ASSERT_EQ(curve.pieces.size() + 1, curve.points.size());
  for (std::size_t i = 0; i < curve.pieces.size(); ++i) {
    ASSERT_EQ(curve.pieces[i].kind, PieceKind::shortest);
    Index face = curve.points[i].surface.face;
    Vec3 at = curve.points[i].position;
    double length = 0.0;
    for (const Crossing& c : curve.piece_crossings(i)) {
      // The path goes on in the face on the other side of the edge.
      ASSERT_GT(c.t, 0.0);
      const Index other = sphere.edges.twin(c.half_edge);
      ASSERT_TRUE(HalfEdges::face(c.half_edge) == face || HalfEdges::face(other) == face);
      face = HalfEdges::face(HalfEdges::face(c.half_edge) == face ? other : c.half_edge);
      length += (position(sphere.mesh, c) - at).norm();
      at = position(sphere.mesh, c);
    }
    EXPECT_EQ(face, curve.points[i + 1].surface.face);
    length += (curve.points[i + 1].position - at).norm();
    EXPECT_NEAR(length, curve.pieces[i].length, 1e-13);
  }
}

TEST(Curve, APieceOnASphereIsAnArcOfAGreatCircle) {
  const Drawn sphere{make_sphere(40)};
  for (Index f = 0; f < sphere.mesh.face_count(); f += 4001) {
    CurveBuilder builder(sphere.surface);
    builder.append(sphere.point({0, kMiddle}));
    builder.append(sphere.point({f, kMiddle}));
    const Vec3 a = builder.curve().points[0].position.normalized();
    const Vec3 b = builder.curve().points[1].position.normalized();
    const double arc = std::atan2(a.cross(b).norm(), a.dot(b));
    // The mesh is inscribed: with edges of 1.8 degrees it is shorter by up to their sagitta, 1e-3.
    EXPECT_NEAR(length(builder.curve()), arc, 1e-3 * arc) << f;
  }
}

TEST(Curve, PointsOnDifferentComponentsAreJoinedByAChord) {
  const Drawn two{make_two_spheres(4)};
  CurveBuilder builder(two.surface);
  builder.append(two.point({0, kMiddle}));
  builder.append(two.point({two.mesh.face_count() - 1, kMiddle}));
  ASSERT_EQ(builder.curve().pieces.size(), 1u);
  EXPECT_EQ(builder.curve().pieces[0].kind, PieceKind::chord);
  EXPECT_EQ(builder.curve().pieces[0].crossing_count, 0u);
  EXPECT_GT(builder.curve().pieces[0].length, 0.2);
}

TEST(Curve, BreakMakesAGapAndTwoPolylines) {
  const Drawn sphere{make_sphere(4)};
  CurveBuilder builder(sphere.surface);
  builder.break_here();  // before the first point: nothing to break
  builder.append(sphere.point({0, kMiddle}));
  builder.append(sphere.point({1, kMiddle}));
  builder.break_here();
  builder.append(sphere.point({40, kMiddle}));
  const ProjectedCurve& curve = builder.curve();
  EXPECT_EQ(curve.pieces[1].kind, PieceKind::gap);
  EXPECT_EQ(curve.pieces[1].length, 0.0);
  const auto parts = polylines(curve, sphere.mesh);
  ASSERT_EQ(parts.size(), 2u);
  EXPECT_EQ(parts[1].size(), 1u);
}

TEST(Curve, FollowsItsTargetByBarycentrics) {
  Drawn sphere{make_sphere(6)};
  CurveBuilder builder(sphere.surface);
  for (Index f = 0; f < 200; f += 20) builder.append(sphere.point({f, kMiddle}));
  ProjectedCurve curve = builder.curve();
  std::vector<Vec3> moved;
  for (const Vec3& x : sphere.mesh.positions()) moved.push_back(3.0 * x + Vec3(1, 0, 0));
  const TriangleMesh larger = sphere.mesh.with_positions(moved);
  follow(curve, larger, sphere.normals);
  EXPECT_NEAR(length(curve), 3.0 * length(builder.curve()), 1e-12);
  EXPECT_LT((curve.points[3].position - (3.0 * builder.curve().points[3].position + Vec3(1, 0, 0)))
                .norm(),
            1e-14);
}

}  // namespace
}  // namespace mimicry
