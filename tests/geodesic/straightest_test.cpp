#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include <mimicry/base/error.h>
#include <mimicry/geodesic/exact.h>
#include <mimicry/geodesic/paths.h>
#include <mimicry/mesh/shapes.h>
#include <mimicry/mesh/surface.h>

#include "geodesic/support.h"
#include "messy/messy_meshes.h"

namespace mimicry {
namespace {

TEST(Straightest, AStraightLineOnAPlaneThroughVerticesToo) {
  const TriangleMesh mesh = make_grid(8);
  const Surface surface = Surface::as_given(mesh);
  Random random(1);
  for (int i = 0; i < 300; ++i) {
    const SurfacePoint a = test::random_point(mesh, random);
    const Vec3 p = mesh.position(a);
    if (p.cwiseAbs().maxCoeff() > 0.5) continue;
    const double turn = i % 2 == 0 ? random.uniform(0.0, 7.0)  // along lines of the grid as well
                                   : random.below(8) * std::numbers::pi / 4;
    const Vec3 direction(std::cos(turn), std::sin(turn), 0.0);
    std::vector<Crossing> crossings;
    const Trace trace = trace_straightest(surface, a, 3.0 * direction, 0.4, &crossings);
    ASSERT_EQ(trace.stop, TraceStop::complete);
    ASSERT_LT((mesh.position(trace.end) - p - 0.4 * direction).norm(), 1e-9);
    ASSERT_LT((trace.direction - direction).norm(), 1e-9);
    ASSERT_NEAR(test::polyline_length(mesh, a, crossings, trace.end), 0.4, 1e-9);
  }
}

TEST(Straightest, StopsAtABoundaryAndSaysWhere) {
  const TriangleMesh mesh = make_grid(4);
  const Surface surface = Surface::as_given(mesh);
  const Trace trace = trace_straightest(surface, {9, Vec3(0.3, 0.3, 0.4)}, Vec3(1, 0.1, 0), 50);
  EXPECT_EQ(trace.stop, TraceStop::boundary);
  EXPECT_NEAR(mesh.position(trace.end).x(), 1.0, 1e-12);
  EXPECT_LT(trace.length, 50.0);
  // From the rim outward it does not move.
  const Trace outward = trace_straightest(surface, trace.end, Vec3(1, 0.1, 0), 1.0);
  EXPECT_EQ(outward.stop, TraceStop::boundary);
  EXPECT_EQ(outward.length, 0.0);
}

double gap_of_a_great_circle(int n) {
  const TriangleMesh mesh = make_sphere(n);
  const Surface surface = Surface::as_given(mesh);
  double worst = 0.0;
  Random random(2);
  for (int i = 0; i < 10; ++i) {
    const SurfacePoint a = test::random_point(mesh, random);
    const Vec3 p = mesh.position(a);
    const Vec3 direction = p.cross(Vec3(random.normal(), random.normal(), random.normal()));
    const Trace trace = trace_straightest(surface, a, direction, 2 * std::numbers::pi);
    EXPECT_EQ(trace.stop, TraceStop::complete);
    worst = std::max(worst, (mesh.position(trace.end) - p).norm());
  }
  return worst;
}

TEST(Straightest, GreatCirclesCloseToTheOrderOfTheMesh) {
  const double coarse = gap_of_a_great_circle(8);
  const double fine = gap_of_a_great_circle(32);
  EXPECT_LT(coarse, 0.2);
  EXPECT_LT(fine, coarse / 4.0);
}

TEST(Straightest, HalvesTheAngleAtTheTipOfACone) {
  const test::Cone cone = test::make_cone(4, 3, 0.6, false);
  const Surface surface = Surface::as_given(cone.mesh);
  const HalfEdges& edges = surface.half_edges();
  // Along a ruling into the tip: out along the one opposite.
  const SurfacePoint start = vertex_point(edges, cone.vertex(1, 2));
  std::vector<Crossing> crossings;
  const Trace trace =
      trace_straightest(surface, start, -cone.mesh.position(cone.vertex(1, 2)), 0.9, &crossings);
  ASSERT_EQ(trace.stop, TraceStop::complete);
  const Vec3 expected = cone.mesh.position(cone.vertex(5, 3)) * (0.9 - 2.0 / 3.0);
  EXPECT_LT((cone.mesh.position(trace.end) - expected).norm(), 1e-9);
  ASSERT_FALSE(crossings.empty());
  EXPECT_EQ(crossings.back().t, 0.0);
  EXPECT_EQ(edges.tail(crossings.back().half_edge), cone.vertex(0, 0));
}

TEST(Straightest, BackAgainFromTheEndOnStudyAndBuiltinShapes) {
  const auto check = [](const TriangleMesh& mesh, std::uint64_t seed) {
    const Surface surface = Surface::as_given(mesh);
    const HalfEdges& edges = surface.half_edges();
    Random random(seed);
    const double length = 0.3 * diagonal(mesh);
    for (int i = 0; i < 30; ++i) {
      SurfacePoint a{
          static_cast<Index>(random.below(static_cast<std::uint32_t>(mesh.face_count()))),
          Vec3(0.3, 0.3, 0.4)};
      const Vec3 direction(random.normal(), random.normal(), random.normal());
      std::vector<Crossing> crossings;
      const Trace there = trace_straightest(surface, a, direction, length, &crossings);
      ASSERT_NEAR(test::polyline_length(mesh, a, crossings, there.end), there.length,
                  1e-9 * length);
      if (there.stop != TraceStop::complete) continue;
      EXPECT_LT(test::largest_turn(mesh, edges, a, crossings, there.end), 1e-5);
      const Trace back = trace_straightest(surface, there.end, -there.direction, length);
      // Errors of direction grow along the way.
      EXPECT_LT((mesh.position(back.end) - mesh.position(a)).norm(), 1e-7 * length);
    }
  };
  for (const ShapeInfo& shape : builtin_shapes()) {
    SCOPED_TRACE(shape.name);
    ShapeOptions options;
    options.resolution = std::clamp(shape.default_resolution / 2, shape.least_resolution, 16);
    check(shape.make(options), 3);
  }
  if (const auto bunny = test::study_mesh("bunny")) check(*bunny, 4);
}

TEST(Straightest, NastyMeshesNeitherHangNorGiveNaN) {
  for (std::uint64_t seed = 0; seed < 500; ++seed) {
    Random random(seed);
    const TriangleMesh mesh = test::nasty_mesh(random);
    const Surface surface = Surface::as_given(mesh);
    const SurfacePoint a = test::random_point(mesh, random);
    const Trace trace =
        trace_straightest(surface, a, Vec3(random.normal(), random.normal(), random.normal()), 5.0);
    ASSERT_TRUE(trace.end.bary.allFinite()) << "seed " << seed;
    ASSERT_TRUE(trace.direction.allFinite()) << "seed " << seed;
    ASSERT_GE(trace.end.bary.minCoeff(), 0.0) << "seed " << seed;
  }
}

TEST(Straightest, BadInputIsNamedAndNoDirectionIsAResult) {
  const TriangleMesh mesh = make_grid(2);
  const Surface surface = Surface::as_given(mesh);
  const SurfacePoint a{0, Vec3(0.3, 0.3, 0.4)};
  EXPECT_THROW(trace_straightest(surface, {9999, Vec3(1, 0, 0)}, Vec3::UnitX(), 1), Error);
  EXPECT_THROW(trace_straightest(surface, a, Vec3(std::nan(""), 0, 0), 1), Error);
  EXPECT_THROW(trace_straightest(surface, a, Vec3::UnitX(), std::nan("")), Error);
  EXPECT_THROW(trace_straightest(surface, a, Vec3::UnitX(), -1), Error);
  EXPECT_EQ(trace_straightest(surface, a, Vec3::UnitZ(), 1).stop, TraceStop::no_direction);
  EXPECT_EQ(trace_straightest(surface, a, Vec3::Zero(), 1).stop, TraceStop::no_direction);
  const Trace stays = trace_straightest(surface, a, Vec3::UnitX(), 0);
  EXPECT_EQ(stays.stop, TraceStop::complete);
  EXPECT_EQ(mesh.position(stays.end), mesh.position(a));
}

TEST(Straightest, CompleteMeansWalkedOnAnyMesh) {
  // A face that names a vertex twice, beside a sound one: there is no way through it.
  const TriangleMesh twice({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {1, 0, 0}, {2, 2, 2}});
  std::size_t complete = 0, other = 0;
  const auto check = [&](const TriangleMesh& mesh, std::uint64_t seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Surface surface = Surface::as_given(mesh);
    Random random(seed);
    for (int i = 0; i < 20; ++i) {
      const SurfacePoint a = test::random_point(mesh, random);
      const Vec3 direction(random.normal(), random.normal(), random.normal());
      const double length = std::pow(10.0, random.uniform(-3.0, 2.0));
      std::vector<Crossing> crossings;
      const Trace trace = trace_straightest(surface, a, direction, length, &crossings);
      ASSERT_TRUE(trace.end.bary.allFinite() && trace.direction.allFinite());
      ASSERT_LE(trace.length, length);
      ASSERT_LE(crossings.size(), 100000u + 300u * static_cast<std::size_t>(mesh.face_count()));
      if (trace.stop == TraceStop::complete) {
        ASSERT_EQ(trace.length, length);
        ++complete;
      } else {
        ++other;
      }
    }
  };
  for (std::uint64_t seed = 0; seed < 20; ++seed) check(twice, seed);
  for (const messy::Family& family : messy::families()) {
    SCOPED_TRACE(family.name);
    check(family.make(40, 1), 1);
  }
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    Random random(seed);
    std::vector<std::uint8_t> bytes(200);
    for (std::uint8_t& b : bytes) b = static_cast<std::uint8_t>(random.bits());
    check(messy::of_bytes(bytes), seed);
  }
  EXPECT_GT(complete, 100u);
  EXPECT_GT(other, 100u);
}

TEST(ParallelTransport, OnAPlaneNothingTurns) {
  const TriangleMesh mesh = make_grid(6);
  const Surface surface = Surface::as_given(mesh);
  ExactGeodesics geodesics(surface);
  Random random(5);
  for (int i = 0; i < 50; ++i) {
    const SurfacePoint a = test::random_point(mesh, random);
    const SurfacePoint b = test::random_point(mesh, random);
    geodesics.compute(a);
    const Vec3 v(random.normal(), random.normal(), 0.0);
    const ExactPath path = geodesics.path_to(b);
    EXPECT_LT((parallel_transport(surface, a, path.crossings, b, v) - v).norm(), 1e-9);
  }
}

TEST(ParallelTransport, KeepsTheTangentOfAStraightestGeodesic) {
  const TriangleMesh mesh = make_noisy_cube(6, 0.1, true, 6);
  const Surface surface = Surface::as_given(mesh);
  Random random(7);
  for (int i = 0; i < 100; ++i) {
    const SurfacePoint a{
        static_cast<Index>(random.below(static_cast<std::uint32_t>(mesh.face_count()))),
        Vec3(0.3, 0.3, 0.4)};
    Vec3 direction(random.normal(), random.normal(), random.normal());
    if (i % 2 == 0)  // through a vertex
      direction = mesh.corner(a.face, 0) - mesh.position(a);
    std::vector<Crossing> crossings;
    const Trace trace = trace_straightest(surface, a, direction, 1.5, &crossings);
    const Vec3 n = face_normal(mesh, a.face);
    const Vec3 tangent = (direction - direction.dot(n) * n).normalized();
    EXPECT_LT(
        (parallel_transport(surface, a, crossings, trace.end, tangent) - trace.direction).norm(),
        1e-8);
  }
}

TEST(ParallelTransport, AroundTheTipOfAConeItTurnsByTheMissingAngle) {
  const test::Cone cone = test::make_cone(5, 2, 0.7, false);
  const Surface surface = Surface::as_given(cone.mesh);
  const HalfEdges& edges = surface.half_edges();
  // Once around the tip over the rulings of the inner ring, half way up.
  std::vector<Crossing> crossings;
  const Index first = edges.outgoing(0);
  Index h = first;
  do {
    h = edges.ccw(h);
    crossings.push_back({h, 0.5});
  } while (h != first);
  const SurfacePoint start{HalfEdges::face(first), Vec3::Constant(1.0 / 3)};
  const Vec3 v = (cone.mesh.corner(start.face, 1) - cone.mesh.corner(start.face, 0)).normalized();
  const Vec3 around = parallel_transport(surface, start, crossings, start, v);
  const double total = cone.sector * cone.directions;
  EXPECT_NEAR(around.norm(), 1.0, 1e-12);
  EXPECT_NEAR(around.dot(v), std::cos(2 * std::numbers::pi - total), 1e-12);
}

}  // namespace
}  // namespace mimicry
