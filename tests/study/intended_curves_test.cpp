#include <algorithm>
#include <string>

#include <gtest/gtest.h>

#include <mimicry/base/error.h>
#include <mimicry/mesh/shapes.h>
#include <mimicry/study/targets.h>

namespace mimicry {
namespace {

Target target_of(std::string_view shape, const ShapeOptions& options = {}) {
  return Target(make_shape(shape, options));
}

TEST(IntendedCurves, ThreeOnEveryShapeOnItsSurfaceAndWithoutJumps) {
  for (const ShapeInfo& info : builtin_shapes()) {
    const Target target = target_of(info.name);
    const auto curves = intended_curves(info.name, target);
    ASSERT_GE(curves.size(), 3u) << info.name;
    int closed = 0;
    for (const Intention& curve : curves) {
      SCOPED_TRACE(std::string(info.name) + " " + curve.name);
      ASSERT_GE(curve.points.size(), 40u);
      closed += curve.closed;
      double length = 0, longest = 0;
      for (std::size_t i = 0; i < curve.points.size(); ++i) {
        const SurfacePoint& p = curve.points[i];
        ASSERT_GE(p.face, 0);
        ASSERT_LT(p.face, target.mesh().face_count());
        EXPECT_GE(p.bary.minCoeff(), 0);
        EXPECT_NEAR(p.bary.sum(), 1, 1e-12);
        if (i == 0) continue;
        const double step = (target.position(p) - target.position(curve.points[i - 1])).norm();
        length += step;
        longest = std::max(longest, step);
      }
      // On the noisy cube steps follow the stretched faces.
      const double spacing = 0.005 * target.diagonal();
      EXPECT_LE(longest, (info.name == "noisy-cube" ? 8 : 2.5) * spacing);
      if (curve.closed) {
        EXPECT_EQ(curve.points.front().face, curve.points.back().face);
        EXPECT_EQ(curve.points.front().bary, curve.points.back().bary);
      }
      // As long as the study's curves: something a person draws in one go.
      const double metres = length * info.metres_per_unit;
      EXPECT_GT(metres, 0.15);
      EXPECT_LT(metres, 1.3);
    }
    EXPECT_GE(closed, 1) << info.name;
  }
}

TEST(IntendedCurves, AcrossTurnsOverSharpEdges) {
  // Face normals along the curve that differ by 90 degrees within a step or two.
  for (const auto& [shape, turns] : {std::pair{"cube", 2}, {"plate", 2}, {"cylinder", 2}}) {
    const Target target = target_of(shape);
    const auto curves = intended_curves(shape, target);
    int found = 0;
    Vec3 previous = Vec3::Zero();
    for (const SurfacePoint& p : curves[2].points) {
      const Vec3 normal = face_normal(target.mesh(), p.face);
      if (previous != Vec3::Zero() && normal.dot(previous) < 0.3) ++found;
      previous = normal;
    }
    EXPECT_EQ(found, turns) << shape;
  }
}

TEST(IntendedCurves, DoNotDependOnResolution) {
  for (const char* shape : {"sphere", "torus", "hand"}) {
    const Target coarse = target_of(shape, {.resolution = shape[0] == 'h' ? 2 : 24});
    const Target fine = target_of(shape, {.resolution = shape[0] == 'h' ? 3 : 48});
    const auto a = intended_curves(shape, coarse), b = intended_curves(shape, fine);
    for (std::size_t c = 0; c < a.size(); ++c)
      for (const SurfacePoint& p : a[c].points) {
        double nearest = kInfinity;
        for (const SurfacePoint& q : b[c].points)
          nearest = std::min(nearest, (coarse.position(p) - fine.position(q)).norm());
        // Half a spacing along, and the facets' own difference.
        EXPECT_LT(nearest, 0.012 * fine.diagonal()) << shape << " " << a[c].name;
      }
  }
}

TEST(IntendedCurves, FollowTheNoisyCubesFaces) {
  const Target noisy = target_of("noisy-cube", {.resolution = 10, .noise = 0.2});
  const Target cube = target_of("cube", {.resolution = 10});
  const auto a = intended_curves("noisy-cube", noisy), b = intended_curves("cube", cube);
  ASSERT_EQ(a[1].points.size(), b[1].points.size());
  EXPECT_EQ(a[1].points[17].face, b[1].points[17].face);
}

TEST(IntendedCurves, RefuseUnknownShapesAndForeignMeshes) {
  const Target sphere = target_of("sphere");
  EXPECT_THROW(intended_curves("teapot", sphere), Error);
  EXPECT_THROW(intended_curves("noisy-cube", sphere), Error);
}

}  // namespace
}  // namespace mimicry
