#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

#include <mimicry/base/error.h>
#include <mimicry/geodesic/exact.h>
#include <mimicry/mesh/shapes.h>

#include "geodesic/support.h"
#include "support/sanitized.h"

namespace mimicry {
namespace {

// A few hundred roundings of lengths of about 1.
constexpr double kRounding = 1e-12;

TEST(ExactGeodesics, StraightLinesOnAPlaneFromEveryVertex) {
  const TriangleMesh mesh = make_grid(7);
  const Surface surface = Surface::as_given(mesh);
  const HalfEdges& edges = surface.half_edges();
  ExactGeodesics geodesics(surface);
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    geodesics.compute(vertex_point(edges, v));
    for (Index w = 0; w < mesh.vertex_count(); ++w)
      ASSERT_NEAR(geodesics.distance(w), (mesh.position(v) - mesh.position(w)).norm(), kRounding)
          << v << " to " << w;
  }
}

TEST(ExactGeodesics, StraightLinesOnAPlaneBetweenPointsOfFacesEdgesAndVertices) {
  const TriangleMesh mesh = make_grid(7);
  const Surface surface = Surface::as_given(mesh);
  ExactGeodesics geodesics(surface);
  Random random(1);
  for (int i = 0; i < 60; ++i) {
    const SurfacePoint a = test::random_point(mesh, random);
    geodesics.compute(a);
    for (int j = 0; j < 30; ++j) {
      const SurfacePoint b = test::random_point(mesh, random);
      const double expected = (mesh.position(a) - mesh.position(b)).norm();
      ASSERT_NEAR(geodesics.distance(b), expected, kRounding);
      const ExactPath path = geodesics.path_to(b);
      ASSERT_TRUE(path.found);
      ASSERT_NEAR(path.length, expected, kRounding);
    }
  }
}

TEST(ExactGeodesics, AllVertexPairsOfASubdividedCubeEqualItsUnfolding) {
  const TriangleMesh coarse = make_box(1, 1, 1, Vec3::Constant(0.5));
  const TriangleMesh mesh = make_box(3, 3, 3, Vec3::Constant(0.5));
  test::UnfoldingOracle oracle(coarse);
  const Surface surface = Surface::as_given(mesh);
  const HalfEdges& edges = surface.half_edges();
  ExactGeodesics geodesics(surface);
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    geodesics.compute(vertex_point(edges, v));
    for (Index w = v; w < mesh.vertex_count(); ++w)
      ASSERT_NEAR(geodesics.distance(w), oracle.distance(mesh.position(v), mesh.position(w)),
                  kRounding)
          << v << " to " << w;
  }
}

TEST(ExactGeodesics, PointsOfRandomTetrahedraEqualTheirUnfolding) {
  Random random(2);
  for (int round = 0; round < 100; ++round) {
    std::vector<Vec3> p(4);
    for (Vec3& x : p) x = Vec3(random.normal(), random.normal(), random.normal());
    const double volume = (p[1] - p[0]).cross(p[2] - p[0]).dot(p[3] - p[0]);
    if (std::abs(volume) < 0.05) continue;
    if (volume > 0) std::swap(p[0], p[1]);
    const TriangleMesh mesh(p, {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}});
    test::UnfoldingOracle oracle(mesh);
    const Surface surface = Surface::as_given(mesh);
    ExactGeodesics geodesics(surface);
    for (int i = 0; i < 5; ++i) {
      const SurfacePoint a = test::random_point(mesh, random);
      geodesics.compute(a);
      for (int j = 0; j < 20; ++j) {
        const SurfacePoint b = test::random_point(mesh, random);
        ASSERT_NEAR(geodesics.distance(b), oracle.distance(mesh.position(a), mesh.position(b)),
                    1e-10)
            << "round " << round;
      }
    }
  }
}

TEST(ExactGeodesics, ConesAndSaddlesEqualTheirUnrolling) {
  struct Case {
    double lift;
    bool zigzag;
  };
  // Total angles of about 180, 360 and 480 degrees.
  for (const Case c : {Case{1.0, false}, Case{0.0, false}, Case{0.35, true}}) {
    const test::Cone cone = test::make_cone(6, 4, c.lift, c.zigzag);
    const Surface surface = Surface::as_given(cone.mesh);
    const HalfEdges& edges = surface.half_edges();
    ExactGeodesics geodesics(surface);
    // A full-angle cone's rim is convex only where the line between two points of it stays inside;
    // from ring 2 every straight line does.
    for (int ring = 0; ring <= 2; ++ring)
      for (int i = 0; i < cone.directions; ++i) {
        geodesics.compute(vertex_point(edges, cone.vertex(i, ring)));
        for (int other = 0; other <= cone.rings; ++other)
          for (int j = 0; j < cone.directions; ++j)
            ASSERT_NEAR(geodesics.distance(cone.vertex(j, other)), cone.distance(i, ring, j, other),
                        kRounding)
                << "lift " << c.lift << ": " << i << ", " << ring << " to " << j << ", " << other;
      }
  }
}

TEST(ExactGeodesics, AnOpenPrismEqualsItsUnrolling) {
  // 12 sides around the z axis, 5 rings: a strip that closes.
  const int n = 12;
  const int rings = 5;
  std::vector<Vec3> positions;
  std::vector<Face> faces;
  for (int r = 0; r <= rings; ++r)
    for (int i = 0; i < n; ++i) {
      const double a = 2 * std::numbers::pi * i / n;
      positions.emplace_back(std::cos(a), std::sin(a), 0.4 * r);
    }
  for (Index r = 0; r < rings; ++r)
    for (Index i = 0; i < n; ++i) {
      const Index j = (i + 1) % n;
      faces.push_back({r * n + i, r * n + j, (r + 1) * n + j});
      faces.push_back({r * n + i, (r + 1) * n + j, (r + 1) * n + i});
    }
  const TriangleMesh mesh(positions, faces);
  const Surface surface = Surface::as_given(mesh);
  const HalfEdges& edges = surface.half_edges();
  const double side = 2 * std::sin(std::numbers::pi / n);
  ExactGeodesics geodesics(surface);
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    geodesics.compute(vertex_point(edges, v));
    for (Index w = 0; w < mesh.vertex_count(); ++w) {
      const Index apart = std::abs(v % n - w % n);
      const double expected = std::hypot(side * std::min(apart, n - apart), 0.4 * (v / n - w / n));
      ASSERT_NEAR(geodesics.distance(w), expected, kRounding) << v << " to " << w;
    }
  }
}

double sphere_error(int n) {
  const TriangleMesh mesh = make_sphere(n);
  const Surface surface = Surface::as_given(mesh);
  const HalfEdges& edges = surface.half_edges();
  ExactGeodesics geodesics(surface);
  geodesics.compute(vertex_point(edges, 0));
  double worst = 0.0;
  for (Index v = 0; v < mesh.vertex_count(); ++v)
    worst = std::max(worst, std::abs(geodesics.distance(v) -
                                     test::angle_between(mesh.position(0), mesh.position(v))));
  return worst;
}

TEST(ExactGeodesics, SphereToTheOrderOfTheMesh) {
  // Faces cut the sphere's area short by h^2 in order.
  const double coarse = sphere_error(6);
  const double fine = sphere_error(12);
  EXPECT_LT(coarse, 0.03);
  EXPECT_LT(fine, coarse / 3.0);
}

TEST(ExactGeodesics, TorusToTheOrderOfTheMesh) {
  // The outer and inner equators and the circle through the source are geodesics; the way around
  // the tube is the shortest to the opposite point of the tube.
  double last = kInfinity;
  for (const int n : {16, 32}) {
    const TriangleMesh mesh = make_torus(3 * n, n);
    const Surface surface = Surface::as_given(mesh);
    const HalfEdges& edges = surface.half_edges();
    ExactGeodesics geodesics(surface);
    geodesics.compute(vertex_point(edges, 0));
    const Vec3 source = mesh.position(0);
    ASSERT_NEAR(source.x(), kTorusMajorRadius + kTorusMinorRadius, 1e-12);
    double worst = 0.0;
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
      const Vec3& p = mesh.position(v);
      if (std::abs(p.y()) > 1e-12 || p.x() < 0.0) continue;
      const double turn =
          std::atan2(std::abs(p.z()), p.x() - kTorusMajorRadius) * kTorusMinorRadius;
      worst = std::max(worst, std::abs(geodesics.distance(v) - turn));
    }
    EXPECT_LT(worst, 0.3 * last);
    EXPECT_LT(worst, 0.05);
    last = worst;
  }
}

TEST(ExactGeodesics, NastyMeshesAgainstTheGraphOracle) {
  for (std::uint64_t seed = 0; seed < 1000; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Random random(seed);
    const TriangleMesh mesh = test::nasty_mesh(random);
    const Surface surface = Surface::as_given(mesh);
    const HalfEdges& edges = surface.half_edges();
    ExactGeodesics geodesics(surface);
    const SurfacePoint source = test::random_point(mesh, random);
    geodesics.compute(source);
    ASSERT_TRUE(geodesics.exact());
    test::GraphOracle oracle(mesh, edges, 7);
    oracle.compute(source);
    const double size = diagonal(mesh);
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
      const double d = geodesics.distance(v);
      if (edges.outgoing(v) < 0) {
        ASSERT_EQ(d, kInfinity);
        continue;
      }
      if (oracle.distance(v) == kInfinity) {
        ASSERT_EQ(d, kInfinity) << v;
        continue;
      }
      // 1e-9: what dropped slivers and flattened faces may cost.
      ASSERT_LE(d, oracle.distance(v) + 1e-9 * size) << v;
      const ExactPath path = geodesics.path_to(vertex_point(edges, v));
      ASSERT_TRUE(path.found) << v;
      ASSERT_NEAR(path.length, d, 1e-9 * size) << v;
      ASSERT_LE(oracle.distance(v), d + oracle.bound(path.crossings) + 1e-9 * size) << v;
    }
  }
}

// Symmetry, triangle inequality, and paths that are as long as the distance and straight.
void check_properties(const TriangleMesh& mesh, std::uint64_t seed, int sources, int targets) {
  const Surface surface = Surface::as_given(mesh);
  const HalfEdges& edges = surface.half_edges();
  ExactGeodesics geodesics(surface);
  ExactGeodesics others(surface);
  Random random(seed);
  const double tolerance = 1e-10 * diagonal(mesh);
  for (int i = 0; i < sources; ++i) {
    const SurfacePoint a = test::random_point(mesh, random);
    geodesics.compute(a);
    const SurfacePoint b = test::random_point(mesh, random);
    others.compute(b);
    const double ab = geodesics.distance(b);
    if (ab == kInfinity) {
      EXPECT_EQ(others.distance(a), kInfinity);
      EXPECT_FALSE(geodesics.path_to(b).found);
      continue;
    }
    EXPECT_NEAR(ab, others.distance(a), tolerance);
    EXPECT_GE(ab, (mesh.position(a) - mesh.position(b)).norm() - tolerance);
    for (int j = 0; j < targets; ++j) {
      const SurfacePoint c = test::random_point(mesh, random);
      const double ac = geodesics.distance(c);
      if (ac == kInfinity) continue;
      EXPECT_LE(ac, ab + others.distance(c) + tolerance);
      const ExactPath path = geodesics.path_to(c);
      ASSERT_TRUE(path.found);
      EXPECT_NEAR(path.length, ac, tolerance);
      EXPECT_NEAR(test::polyline_length(mesh, a, path.crossings, c), ac, tolerance);
      // Directions between points 1e-6 apart, from points known to 1e-13.
      EXPECT_LT(test::largest_turn(mesh, edges, a, path.crossings, c), 1e-5);
    }
  }
}

TEST(ExactGeodesics, PropertiesOnBuiltinShapes) {
  for (const ShapeInfo& shape : builtin_shapes()) {
    SCOPED_TRACE(shape.name);
    ShapeOptions options;
    options.resolution = std::clamp(shape.default_resolution / 4, shape.least_resolution, 8);
    check_properties(shape.make(options), 3, 4, 6);
  }
}

TEST(ExactGeodesics, PropertiesOnTheStudysShapes) {
  for (const char* name : {"torus", "cube", "trebol", "hand", "fertility", "bunny"}) {
    const auto mesh = test::study_mesh(name);
    if (!mesh) GTEST_SKIP() << "no study data";
    SCOPED_TRACE(name);
    check_properties(*mesh, 4, 2, 6);
  }
}

TEST(ExactGeodesics, TheGraphOracleComesDownToItAsPointsAreAdded) {
  const TriangleMesh mesh = make_noisy_cube(3, 0.2, true, 9);
  const Surface surface = Surface::as_given(mesh);
  const HalfEdges& edges = surface.half_edges();
  ExactGeodesics geodesics(surface);
  const SurfacePoint source{5, Vec3(0.5, 0.2, 0.3)};
  geodesics.compute(source);
  double last = kInfinity;
  for (const int points : {3, 9, 33}) {
    test::GraphOracle oracle(mesh, edges, points);
    oracle.compute(source);
    double worst = 0.0;
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
      const double over = oracle.distance(v) - geodesics.distance(v);
      ASSERT_GE(over, -kRounding) << v;
      worst = std::max(worst, over);
    }
    // Half a spacing aside costs the square of it, where the path crosses edges slantwise less.
    EXPECT_LT(worst, 0.25 * last) << points;
    last = worst;
  }
  EXPECT_LT(last, 2e-3);
}

// The same surface, moved, scaled, with vertices and faces backwards and their corners turned.
void check_invariance(const TriangleMesh& mesh, std::uint64_t seed, double scale) {
  const Surface surface = Surface::as_given(mesh);
  ExactGeodesics geodesics(surface);
  Random random(seed);
  const SurfacePoint source = test::random_point(mesh, random);
  geodesics.compute(source);
  const Mat3 turn = Quat(Eigen::AngleAxisd(1.1, Vec3(1, 2, 3).normalized())).toRotationMatrix();
  const Index last = mesh.vertex_count() - 1;
  std::vector<Vec3> positions(mesh.positions().size());
  for (Index v = 0; v <= last; ++v)
    positions[static_cast<std::size_t>(last - v)] =
        scale * (turn * mesh.position(v) + Vec3(3, -2, 1));
  std::vector<Face> faces;
  for (Index f = mesh.face_count() - 1; f >= 0; --f)
    faces.push_back({last - mesh.face(f)[1], last - mesh.face(f)[2], last - mesh.face(f)[0]});
  const TriangleMesh moved(positions, faces);
  ExactGeodesics others(Surface::as_given(moved));
  others.compute(
      {moved.face_count() - 1 - source.face, Vec3(source.bary[1], source.bary[2], source.bary[0])});
  for (Index v = 0; v <= last; ++v) {
    const double expected = geodesics.distance(v);
    if (expected == kInfinity)
      ASSERT_EQ(others.distance(last - v), kInfinity) << v;
    else
      ASSERT_NEAR(others.distance(last - v), scale * expected, 1e-11 * scale * diagonal(mesh)) << v;
  }
}

TEST(ExactGeodesics, RigidMotionScaleAndNumberingChangeNothingOnBuiltinShapes) {
  for (const ShapeInfo& shape : builtin_shapes()) {
    SCOPED_TRACE(shape.name);
    ShapeOptions options;
    options.resolution = std::clamp(shape.default_resolution / 4, shape.least_resolution, 6);
    for (const double scale : {1e-6, 1.0, 1e6}) check_invariance(shape.make(options), 5, scale);
  }
}

TEST(ExactGeodesics, RigidMotionScaleAndNumberingChangeNothingOnTheStudysShapes) {
  for (const char* name : {"torus", "cube", "trebol", "hand", "fertility", "bunny"}) {
    const auto mesh = test::study_mesh(name);
    if (!mesh) GTEST_SKIP() << "no study data";
    SCOPED_TRACE(name);
    check_invariance(*mesh, 6, 0.01);
    if (test::kSanitized) break;  // one of them takes ten seconds
  }
}

TEST(ExactGeodesics, OfSeveralSourcesTheNearestCountsFromWhereItStarts) {
  const TriangleMesh mesh = make_noisy_cube(4, 0.1, false, 6);
  const Surface surface = Surface::as_given(mesh);
  const HalfEdges& edges = surface.half_edges();
  ExactGeodesics all(surface);
  ExactGeodesics one(surface);
  Random random(7);
  std::vector<Source> sources;
  for (int i = 0; i < 4; ++i) sources.push_back({test::random_point(mesh, random), 0.1 * i});
  sources.push_back(sources[0]);  // twice the same
  all.compute(sources);
  std::vector<double> nearest(static_cast<std::size_t>(mesh.vertex_count()), kInfinity);
  for (const Source& s : sources) {
    one.compute({&s, 1});
    for (Index v = 0; v < mesh.vertex_count(); ++v)
      nearest[static_cast<std::size_t>(v)] =
          std::min(nearest[static_cast<std::size_t>(v)], one.distance(v));
  }
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    ASSERT_NEAR(all.distance(v), nearest[static_cast<std::size_t>(v)], kRounding);
    const ExactPath path = all.path_to(vertex_point(edges, v));
    ASSERT_TRUE(path.found);
    ASSERT_NEAR(path.length + sources[path.source].distance, all.distance(v), kRounding);
  }
}

TEST(ExactGeodesics, StopsAtARadiusAndAtTargets) {
  const TriangleMesh mesh = make_torus(36, 12);
  const Surface surface = Surface::as_given(mesh);
  ExactGeodesics full(surface);
  ExactGeodesics stopped(surface);
  const SurfacePoint source{17, Vec3(0.2, 0.2, 0.6)};
  full.compute(source);
  ExactOptions radius;
  radius.radius = 0.4;
  const Source one{source, 0.0};
  stopped.compute({&one, 1}, radius);
  for (Index v = 0; v < mesh.vertex_count(); ++v)
    EXPECT_EQ(stopped.distance(v), full.distance(v) <= 0.4 ? full.distance(v) : kInfinity) << v;
  EXPECT_LT(stopped.windows_made(), full.windows_made() / 4);

  const std::vector<SurfacePoint> targets = {{40, Vec3(0.3, 0.3, 0.4)}, {90, Vec3(1, 0, 0)}};
  ExactOptions until;
  until.targets = targets;
  stopped.compute({&one, 1}, until);
  for (const SurfacePoint& t : targets) {
    EXPECT_DOUBLE_EQ(stopped.distance(t), full.distance(t));
    EXPECT_DOUBLE_EQ(stopped.path_to(t).length, full.path_to(t).length);
  }
  EXPECT_LT(stopped.windows_made(), full.windows_made());
}

TEST(ExactGeodesics, GivesUpWithUpperBoundsWhenItsWorkIsBounded) {
  const TriangleMesh mesh = make_sphere(6);
  const Surface surface = Surface::as_given(mesh);
  const HalfEdges& edges = surface.half_edges();
  ExactGeodesics full(surface);
  ExactGeodesics bounded(surface);
  full.compute(vertex_point(edges, 5));
  const Source one{vertex_point(edges, 5), 0.0};
  ExactOptions options;
  options.most_windows = 100;
  bounded.compute({&one, 1}, options);
  EXPECT_FALSE(bounded.exact());
  for (Index v = 0; v < mesh.vertex_count(); ++v)
    EXPECT_GE(bounded.distance(v), full.distance(v) - kRounding);
}

TEST(ExactGeodesics, SameInputGivesTheSameBits) {
  const TriangleMesh mesh = make_noisy_cube(4, 0.2, true, 8);
  const Surface surface = Surface::as_given(mesh);
  const HalfEdges& edges = surface.half_edges();
  ExactGeodesics a(surface);
  ExactGeodesics b(surface);
  b.compute(vertex_point(edges, 9));  // what was computed before leaves nothing behind
  a.compute(vertex_point(edges, 2));
  b.compute(vertex_point(edges, 2));
  for (Index v = 0; v < mesh.vertex_count(); ++v) EXPECT_EQ(a.distance(v), b.distance(v));
}

TEST(ExactGeodesics, BadInputIsNamed) {
  const TriangleMesh mesh = make_grid(2);
  const Surface surface = Surface::as_given(mesh);
  ExactGeodesics geodesics(surface);
  EXPECT_THROW(geodesics.compute({99, Vec3(1, 0, 0)}), Error);
  EXPECT_THROW(geodesics.compute({-1, Vec3(1, 0, 0)}), Error);
  EXPECT_THROW(geodesics.compute({0, Vec3(0.5, 0.5, 0.5)}), Error);
  EXPECT_THROW(geodesics.compute({0, Vec3(1.1, -0.1, 0.0)}), Error);
  EXPECT_THROW(geodesics.compute({0, Vec3(std::nan(""), 0.5, 0.5)}), Error);
  EXPECT_NO_THROW(geodesics.compute({0, Vec3(1.0 + 5e-7, -5e-7, 0.0)}));
  const Source negative{{0, Vec3(1, 0, 0)}, -1.0};
  EXPECT_THROW(geodesics.compute({&negative, 1}), Error);
  const Source good{{0, Vec3(1, 0, 0)}, 0.0};
  ExactOptions options;
  for (const double radius : {-1.0, std::nan("")}) {
    options.radius = radius;
    EXPECT_THROW(geodesics.compute({&good, 1}, options), Error);
  }
  const SurfacePoint off{99, Vec3(1, 0, 0)};
  options = {};
  options.targets = {&off, 1};
  EXPECT_THROW(geodesics.compute({&good, 1}, options), Error);
  geodesics.compute({&good, 1});
  EXPECT_THROW(geodesics.path_to(off), Error);
  EXPECT_THROW(geodesics.distance(SurfacePoint{0, Vec3(2, 0, 0)}), Error);
  EXPECT_THROW(ExactGeodesics(Surface::as_given(mesh.with_positions(
                   std::vector<Vec3>(mesh.positions().size(), Vec3::Constant(kInfinity))))),
               Error);
}

TEST(ExactGeodesics, WithoutSourcesNothingIsReachable) {
  const TriangleMesh mesh = make_two_spheres(2);
  const Surface surface = Surface::as_given(mesh);
  const HalfEdges& edges = surface.half_edges();
  ExactGeodesics geodesics(surface);
  geodesics.compute(std::span<const Source>{});
  EXPECT_EQ(geodesics.distance(0), kInfinity);
  EXPECT_FALSE(geodesics.path_to(vertex_point(edges, 0)).found);
}

TEST(ExactGeodesics, NoPathLeadsOverAVertexThatOnlyFacesThatNameItTwiceUse) {
  // Two triangles, and between them a vertex that no half-edge leaves.
  const TriangleMesh mesh(
      {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 2, 0}, {0, 3, 0}, {1, 4, 0}, {0, 4, 0}},
      {{0, 1, 2}, {2, 3, 3}, {3, 3, 4}, {4, 5, 6}});
  const Surface surface = Surface::as_given(mesh);
  ASSERT_LT(surface.half_edges().outgoing(3), 0);
  ExactGeodesics geodesics(surface);
  geodesics.compute({0, Vec3(0, 0, 1)});
  const SurfacePoint target{3, Vec3::Constant(1.0 / 3.0)};
  ASSERT_LT(geodesics.distance(target), kInfinity);  // the way is there, its crossings are not
  EXPECT_FALSE(geodesics.path_to(target).found);
}

}  // namespace
}  // namespace mimicry
