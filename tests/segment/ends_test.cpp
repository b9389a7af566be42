#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <mimicry/base/error.h>
#include <mimicry/mesh/shapes.h>
#include <mimicry/mesh/validation.h>
#include <mimicry/segment/segment.h>

#include "curve/support.h"

namespace mimicry {
namespace {

using test::Drawn;
using testing::ElementsAre;
using testing::HasSubstr;

// Around the z axis of a sphere at z = 0.5, from one angle to another.
ProjectedCurve turn_around(const Drawn& sphere, double from, double to, double rise = 0.0) {
  std::vector<Vec3> points;
  const int count = 60;
  for (int i = 0; i <= count; ++i) {
    const double s = static_cast<double>(i) / count, a = from + s * (to - from);
    const double z = 0.5 + rise * (s - 0.5);
    const double r = std::sqrt(1.0 - z * z);
    points.emplace_back(r * std::cos(a), r * std::sin(a), z);
  }
  return sphere.curve_near(points);
}

Segmentation cut(const Drawn& target, const ProjectedCurve& curve,
                 CloseCurves close = CloseCurves::automatic) {
  SegmentOptions options;
  options.close = close;
  return segment(target.surface, std::vector{curve}, options);
}

TEST(Ends, NearEndsAreJoined) {
  const Drawn sphere{make_shape("sphere", {.resolution = 16})};
  const ProjectedCurve curve = turn_around(sphere, 0.1, 5.4);  // 5.3 of 6.28
  const Segmentation closed = cut(sphere, curve);
  EXPECT_EQ(closed.parts.size(), 2u);
  EXPECT_THAT(closed.notes, ElementsAre(HasSubstr("curve 0: closed by a geodesic of 0.8")));
  EXPECT_TRUE(closed.seams[0].closed);
  const Segmentation slit = cut(sphere, curve, CloseCurves::never);
  EXPECT_EQ(slit.parts.size(), 1u);
  EXPECT_EQ(slit.parts[0].euler, 1);
}

TEST(Ends, FarEndsStayASlitUnlessTold) {
  const Drawn sphere{make_shape("sphere", {.resolution = 16})};
  const ProjectedCurve curve = turn_around(sphere, 0.1, 3.2);
  const Segmentation slit = cut(sphere, curve);
  EXPECT_EQ(slit.parts.size(), 1u);
  ASSERT_FALSE(slit.notes.empty());
  EXPECT_THAT(slit.notes[0], HasSubstr("curve 0: is open, and a slit"));
  EXPECT_EQ(cut(sphere, curve, CloseCurves::always).parts.size(), 2u);
}

TEST(Ends, EndsThatCrossAreTrimmed) {
  const Drawn sphere{make_shape("sphere", {.resolution = 16})};
  std::vector<Vec3> points;
  for (int i = 0; i <= 60; ++i) {
    const double a = -0.3 + (kTau + 0.6) * i / 60;  // the ends cross near angle 0
    points.push_back(Vec3(0.6 * std::cos(a) + 0.3 * std::max(0.0, std::abs(i - 30.0) - 25.0) / 5,
                          0.6 * std::sin(a), 0.9)
                         .normalized());
  }
  const ProjectedCurve curve = sphere.curve_near(points);
  const Segmentation trimmed = cut(sphere, curve);
  EXPECT_EQ(trimmed.parts.size(), 2u);
  ASSERT_EQ(trimmed.notes.size(), 1u);
  EXPECT_THAT(trimmed.notes[0], HasSubstr("closed where its ends cross"));
  for (const SurfacePart& part : trimmed.parts) EXPECT_EQ(part.euler, 1);
  // Untrimmed, tails stick out on both sides.
  const Segmentation drawn = cut(sphere, curve, CloseCurves::never);
  EXPECT_EQ(drawn.parts.size(), 2u);
  EXPECT_LT(length(trimmed.seams[0]), length(drawn.seams[0]));
}

TEST(Ends, EndsNearABoundaryAreLedToIt) {
  const Drawn grid{make_grid(12)};
  const ProjectedCurve across = grid.curve_near(
      std::vector<Vec3>{{-0.93, 0.1, 0}, {-0.3, 0.2, 0}, {0.4, -0.1, 0}, {0.91, 0.3, 0}});
  const Segmentation halves = cut(grid, across);
  EXPECT_EQ(halves.parts.size(), 2u);
  ASSERT_FALSE(halves.notes.empty());
  EXPECT_THAT(halves.notes[0], HasSubstr("both ends were led to the boundary by 0.16"));
  for (const SurfacePart& part : halves.parts) {
    EXPECT_EQ(part.euler, 1);
    EXPECT_EQ(part.boundary_loops, 1);
  }
  EXPECT_EQ(cut(grid, across, CloseCurves::never).parts.size(), 1u);
  const ProjectedCurve inside =
      grid.curve_near(std::vector<Vec3>{{-0.5, 0.1, 0}, {0.4, -0.1, 0}, {0.5, 0.3, 0}});
  EXPECT_EQ(cut(grid, inside).parts.size(), 1u);
}

TEST(Ends, ACurveWithGapsIsCutAsDrawn) {
  const Drawn spheres{make_shape("two-spheres", {.resolution = 6})};
  std::vector<Vec3> points;
  for (const double x : {-0.55, 0.55})
    for (int i = 0; i <= 12; ++i)
      points.emplace_back(x, 0.45 * std::cos(kTau * i / 12), 0.45 * std::sin(kTau * i / 12));
  const Segmentation both = cut(spheres, spheres.curve_near(points));
  ASSERT_FALSE(both.notes.empty());
  EXPECT_THAT(both.notes[0], HasSubstr("has gaps"));
  EXPECT_EQ(both.parts.size(), 4u);
}

TEST(Selection, ChoosesByAreaSideAndFace) {
  const Drawn sphere{make_shape("sphere", {.resolution = 16})};
  // Counter-clockwise seen from the pole: the cap is to the left.
  const ProjectedCurve curve = turn_around(sphere, 0.0, kTau - 0.05);
  const Segmentation cap = cut(sphere, curve);
  ASSERT_EQ(cap.parts.size(), 2u);
  const Index small = smallest_part(cap);
  EXPECT_NEAR(cap.parts[at(small)].area_share, 0.25, 0.01);
  EXPECT_EQ(left_part(cap), small);
  EXPECT_EQ(right_part(cap), 1 - small);
  EXPECT_EQ(part_of_face(cap, sphere.locate(Vec3::UnitZ()).face), small);
  EXPECT_EQ(part_of_face(cap, sphere.locate(-Vec3::UnitZ()).face), 1 - small);
  EXPECT_THROW(part_of_face(cap, sphere.mesh.face_count()), Error);
  EXPECT_THROW(left_part(segment(sphere.surface, {})), Error);
}

TEST(Vertices, CutsAlongEdgesAndConvergesToExact) {
  double last = 1.0;
  for (const int resolution : {8, 16, 32}) {
    const Drawn sphere{make_shape("sphere", {.resolution = resolution})};
    const ProjectedCurve curve = turn_around(sphere, 0.0, kTau - 0.05);
    SegmentOptions options;
    options.method = CutMethod::vertices;
    const Segmentation rough = segment(sphere.surface, std::vector{curve}, options);
    EXPECT_EQ(rough.surface.mesh().face_count(), sphere.mesh.face_count());
    EXPECT_EQ(rough.surface.mesh().vertex_count(), sphere.mesh.vertex_count());
    EXPECT_TRUE(rough.separated);
    const Segmentation exact = segment(sphere.surface, std::vector{curve});
    const double off = std::abs(rough.parts[at(left_part(rough))].area_share -
                                exact.parts[at(left_part(exact))].area_share);
    EXPECT_LT(off, 0.5 / resolution);
    last = off;
  }
  EXPECT_LT(last, 0.005);
}

}  // namespace
}  // namespace mimicry
