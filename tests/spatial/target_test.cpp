#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <mimicry/base/error.h>
#include <mimicry/mesh/shapes.h>
#include <mimicry/spatial/target.h>

#include "spatial/meshes.h"
#include "support/allocations.h"

namespace mimicry {
namespace {

using mimicry::test::allocation_count;
using test::Random;
using test::uniform_vector;
using ::testing::HasSubstr;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

TriangleMesh one_triangle() {
  return {{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)}, {{0, 1, 2}}};
}

std::string refusal(const TriangleMesh& mesh, const TargetOptions& options = {}) {
  try {
    Target target(mesh, options);
  } catch (const Error& e) {
    EXPECT_EQ(e.kind(), ErrorKind::invalid_input);
    return e.what();
  }
  return "";
}

TEST(Target, ClosestPointAndRayOnOneTriangle) {
  const Target target(one_triangle());
  const auto p = target.closest_point(Vec3(0.25, 0.5, 2));
  ASSERT_TRUE(p.has_value());
  EXPECT_EQ(p->surface.face, 0);
  EXPECT_LT((p->position - Vec3(0.25, 0.5, 0)).norm(), 1e-15);
  EXPECT_NEAR(p->distance, 2.0, 1e-15);
  const auto hit = target.first_hit(Vec3(0.25, 0.5, 2), Vec3(0, 0, -7));
  ASSERT_TRUE(hit.has_value());
  EXPECT_NEAR(hit->distance, 2.0, 1e-15);  // length, whatever the direction's
  EXPECT_EQ(target.normal(hit->surface), Vec3(0, 0, 1));
  EXPECT_FALSE(target.first_hit(Vec3(0.25, 0.5, 2), Vec3(0, 0, 1)).has_value());
}

TEST(Target, UpperBoundIncludesItself) {
  const Target target(one_triangle());
  EXPECT_TRUE(target.closest_point(Vec3(0.25, 0.25, 2), 2.0).has_value());
  EXPECT_FALSE(target.closest_point(Vec3(0.25, 0.25, 2), 1.999999).has_value());
  EXPECT_FALSE(target.closest_point(Vec3(0.25, 0.25, 2), kNaN).has_value());
}

TEST(Target, WhatIsNotANumberFindsNothing) {
  const Target target(make_torus(10, 6, 1.0, 0.4));
  for (const double bad : {kNaN, kInfinity, -kInfinity, 1e300}) {
    for (int k = 0; k < 3; ++k) {
      Vec3 y(1, 2, 3);
      y[k] = bad;
      EXPECT_FALSE(target.closest_point(y).has_value());
      EXPECT_FALSE(target.first_hit(y, Vec3(1, 0, 0)).has_value());
      if (std::isfinite(bad)) continue;
      EXPECT_FALSE(target.first_hit(Vec3::Zero(), y).has_value());
    }
  }
  EXPECT_FALSE(target.first_hit(Vec3::Zero(), Vec3::Zero()).has_value());
}

TEST(Target, DirectionsOfAnyLengthGiveTheSameHit) {
  const Target target(make_torus(20, 10, 1.0, 0.4));
  const Vec3 direction(1, 0.3, 0.1);
  const auto expected = target.first_hit(Vec3::Zero(), direction);
  ASSERT_TRUE(expected.has_value());
  for (const double length : {1e-300, 1e-3, 1e300}) {
    const auto hit = target.first_hit(Vec3::Zero(), length * direction);
    ASSERT_TRUE(hit.has_value());
    EXPECT_EQ(hit->surface.face, expected->surface.face);
    EXPECT_NEAR(hit->distance, expected->distance, 1e-14);
  }
}

TEST(Target, AllHitsComeByDistance) {
  const Target target(make_torus(40, 20, 1.0, 0.4));
  std::vector<RayHit> hits(1);
  target.all_hits(Vec3(-5, 0.01, 0.02), Vec3(1, 0, 0), hits);
  ASSERT_EQ(hits.size(), 5U);
  EXPECT_EQ(hits[0].surface.face, kNone);  // what was there stays
  const double expected[] = {3.6, 4.4, 5.6, 6.4};
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(hits[i + 1].distance, expected[i], 0.02);
}

TEST(Target, TiesGoToTheLowerFace) {
  // The cube's centre is equally far from all faces; each corner belongs to several.
  const Target target(make_box(2, 2, 2, Vec3::Ones()));
  EXPECT_EQ(target.closest_point(Vec3::Zero())->surface.face, 0);
  const TriangleMesh& mesh = target.mesh();
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    Index lowest = 0;
    while (mesh.face(lowest)[0] != v && mesh.face(lowest)[1] != v && mesh.face(lowest)[2] != v)
      ++lowest;
    for (Index hint = 0; hint < mesh.face_count(); hint += 5)
      EXPECT_EQ(target.closest_point(mesh.position(v), kInfinity, hint)->surface.face, lowest);
  }
}

TEST(Target, ScaleAndPlaceDoNotMatter) {
  const TriangleMesh mesh = make_torus(40, 20, 1.0, 0.4);
  const Target target(mesh);
  Random random(41);
  for (const double scale : {1e-6, 1.0, 1e6}) {
    const Vec3 offset = scale == 1.0 ? Vec3(1e4, -1e4, 5e3) : Vec3::Zero();
    const Target other(test::transformed(mesh, scale, offset));
    // What the coordinates themselves lose 1e4 units away.
    const double tolerance = scale == 1.0 ? 1e-11 : 1e-14;
    for (int i = 0; i < 300; ++i) {
      const Vec3 y = uniform_vector(random, 2.0);
      const auto a = target.closest_point(y), b = other.closest_point(scale * y + offset);
      EXPECT_NEAR(a->distance, b->distance / scale, tolerance);
      const Vec3 d = test::unit_vector(random);
      const auto h = target.first_hit(y, d), g = other.first_hit(scale * y + offset, d);
      ASSERT_EQ(h.has_value(), g.has_value());
      if (h) {
        EXPECT_NEAR(h->distance, g->distance / scale, 1e3 * tolerance);
      }
    }
  }
}

TEST(Target, FaceWithoutAreaIsNeverTheClosest) {
  // Face 0 lies in the middle of the side that both others share.
  const Target target(
      {{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0.5, 0, 0), Vec3(0, 1, 0), Vec3(0, -1, 0)},
       {{0, 2, 1}, {0, 1, 3}, {1, 0, 4}}});
  EXPECT_EQ(target.closest_point(Vec3(0.5, 0, 1))->surface.face, 1);
  EXPECT_EQ(target.first_hit(Vec3(0.5, 0, 1), Vec3(0, 0, -1))->surface.face, 1);
}

TEST(Target, RefusesWhatCannotBeDrawnOn) {
  EXPECT_THAT(refusal(TriangleMesh()), HasSubstr("no faces"));
  EXPECT_THAT(refusal({{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(2, 0, 0)}, {{0, 1, 2}}}),
              HasSubstr("none of the 1 faces has an area"));
  EXPECT_THAT(refusal({{Vec3(1, 1, 1)}, {{0, 0, 0}}}), HasSubstr("none of the 1 faces"));
  EXPECT_THAT(refusal({{Vec3(0, 0, 0), Vec3(1, kNaN, 0), Vec3(0, 1, kInfinity)}, {{0, 1, 2}}}),
              HasSubstr("2 vertices are not finite (first: vertex 1)"));
  EXPECT_THAT(refusal({{Vec3(0, 0, 0), Vec3(1e200, 0, 0), Vec3(0, 1, 0)}, {{0, 1, 2}}}),
              HasSubstr("beyond 1e30"));
  EXPECT_THAT(refusal({{Vec3(0, 0, 0), Vec3(1e-200, 0, 0), Vec3(0, 1e-200, 0)}, {{0, 1, 2}}}),
              HasSubstr("smaller than 1e-30"));
}

TEST(Target, MendsNonManifoldUnlessStrict) {
  const TriangleMesh book(
      {Vec3(0, 0, 0), Vec3(0, 0, 1), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(-1, 0, 0)},
      {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}});
  EXPECT_THAT(refusal(book, {.strict = true}),
              HasSubstr("1 edge of three or more faces was split (first: vertices 0-1)"));
  const TriangleMesh bow(
      {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(-1, 0, 0), Vec3(-1, -1, 0)},
      {{0, 1, 2}, {0, 3, 4}});
  EXPECT_THAT(refusal(bow, {.strict = true}),
              HasSubstr("1 vertex where sheets meet was split (first: vertex 0)"));
  for (const TriangleMesh& mesh : {book, bow}) {
    const Target target(mesh);
    EXPECT_TRUE(target.half_edges().is_manifold());
    EXPECT_TRUE(target.closest_point(Vec3(3, 3, 3)).has_value());
  }
}

TEST(Target, StandsOnWhatFacesUse) {
  // A stray vertex far away, and one that is no number.
  const Target target(
      {{Vec3(1e6, 0, 0), Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(kNaN, kNaN, kNaN)},
       {{1, 2, 3}}},
      {.strict = true});
  EXPECT_DOUBLE_EQ(target.diagonal(), std::sqrt(2.0));
  EXPECT_EQ(target.connection().unused_vertices.count, 2);
}

TEST(Target, FacesThatAreLeftOutAreNeverMet) {
  // A square, and its first face again from behind.
  const Target target({{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0)},
                       {{0, 1, 2}, {0, 2, 1}, {0, 2, 3}, {0, 0, 2}}});
  EXPECT_EQ(target.mesh().face_count(), 4);
  std::vector<RayHit> hits;
  target.all_hits(Vec3(0.7, 0.3, 1), Vec3(0, 0, -1), hits);
  ASSERT_EQ(hits.size(), 1u);
  EXPECT_EQ(hits[0].surface.face, 0);
  // Through the corner that the collapsed faces shrink to.
  hits.clear();
  target.all_hits(Vec3(0, 0, 1), Vec3(0, 0, -1), hits);
  for (const RayHit& hit : hits) EXPECT_TRUE(hit.surface.face == 0 || hit.surface.face == 2);
  EXPECT_EQ(target.closest_point(Vec3(0, 0, 1))->surface.face, 0);
  EXPECT_EQ(target.vertex_normals()[0], Vec3(0, 0, 1));
}

TEST(Target, MovedSeamsStayClosed) {
  // Two triangles with vertices of their own along a seam; positions come by the caller's numbers.
  const std::vector<Vec3> flat = {Vec3(9, 9, 9), Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0),
                                  Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0)};
  Target target({flat, {{1, 2, 3}, {4, 5, 6}}});
  EXPECT_EQ(target.mesh().vertex_count(), 4);
  std::vector<Vec3> lifted = flat;
  for (Vec3& x : lifted) x += Vec3(0, 0, 2);
  target.update_positions(lifted);
  EXPECT_EQ(target.closest_point(Vec3(0.9, 0.9, 5))->position, Vec3(0.9, 0.9, 2));
  EXPECT_THROW(target.update_positions({lifted.data(), 4}), Error);
}

TEST(Target, MovedPositionsAnswerAsANewTarget) {
  const TriangleMesh mesh = make_torus(40, 20, 1.0, 0.4);
  Target moved(mesh);
  const TriangleMesh shape = test::transformed(mesh, 0.01, Vec3(3, 4, 5));
  const long before = allocation_count();
  moved.update_positions(shape.positions());
  EXPECT_EQ(allocation_count(), before);
  const Target fresh(shape);
  EXPECT_EQ(moved.diagonal(), fresh.diagonal());
  Random random(42);
  for (int i = 0; i < 300; ++i) {
    const Vec3 y = Vec3(3, 4, 5) + uniform_vector(random, 0.02);
    const auto a = moved.closest_point(y), b = fresh.closest_point(y);
    ASSERT_EQ(a->surface.face, b->surface.face);
    ASSERT_EQ(a->position, b->position);
    ASSERT_EQ(moved.normal(a->surface), fresh.normal(b->surface));
  }
}

TEST(Target, BadPositionsChangeNothing) {
  const TriangleMesh mesh = make_torus(10, 6, 1.0, 0.4);
  Target target(mesh);
  std::vector<Vec3> positions(mesh.positions().begin(), mesh.positions().end());
  EXPECT_THROW(target.update_positions(std::span(positions).first(5)), Error);
  positions[7][1] = kNaN;
  EXPECT_THROW(target.update_positions(positions), Error);
  std::fill(positions.begin(), positions.end(), Vec3::Ones());
  EXPECT_THROW(target.update_positions(positions), Error);
  const Target fresh(mesh);
  EXPECT_EQ(target.mesh().position(7), mesh.position(7));
  EXPECT_EQ(target.diagonal(), fresh.diagonal());
  EXPECT_EQ(target.closest_point(Vec3(3, 0, 0))->position,
            fresh.closest_point(Vec3(3, 0, 0))->position);
}

TEST(Target, QueriesAllocateNothing) {
  const Target target(make_torus(100, 50, 1.0, 0.4));
  Random random(43);
  const long before = allocation_count();
  Index hint = kNone;
  double sum = 0.0;
  for (int i = 0; i < 500; ++i) {
    const Vec3 y = uniform_vector(random, i % 5 == 0 ? 1e6 : 2.0);
    const auto p = target.closest_point(y, kInfinity, hint);
    hint = p->surface.face;
    sum += p->distance;
    if (const auto hit = target.first_hit(y, -y)) sum += hit->distance;
  }
  EXPECT_EQ(allocation_count(), before);
  EXPECT_GT(sum, 0.0);
}

TEST(Target, HoldsUnder200BytesAFace) {
  const Target target(make_torus(360, kLargeTorusResolution));
  ASSERT_EQ(target.mesh().face_count(), 86400);
  const double bytes = static_cast<double>(target.memory_bytes()) / target.mesh().face_count();
  RecordProperty("bytes_a_face", std::to_string(bytes));
  EXPECT_LT(bytes, 200.0);
}

}  // namespace
}  // namespace mimicry
