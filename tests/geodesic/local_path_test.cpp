#include <gtest/gtest.h>

#include <mimicry/base/error.h>
#include <mimicry/geodesic/exact.h>
#include <mimicry/geodesic/paths.h>
#include <mimicry/mesh/shapes.h>

#include "geodesic/support.h"
#include "support/allocations.h"

namespace mimicry {
namespace {

void check_pairs(const TriangleMesh& mesh, std::uint64_t seed, int sources, int targets,
                 double longest, double tolerance) {
  const Surface surface = Surface::as_given(mesh);
  const HalfEdges& edges = surface.half_edges();
  // Vertices where fans touch are passed by the one search and not by the other.
  if (!edges.is_manifold()) return;
  ExactGeodesics geodesics(surface);
  LocalPathFinder finder(surface);
  Random random(seed);
  const double size = diagonal(mesh);
  std::vector<Crossing> crossings;
  for (int i = 0; i < sources; ++i) {
    const SurfacePoint a = test::random_point(mesh, random);
    const Source one{a, 0.0};
    ExactOptions options;
    options.radius = longest * size;
    geodesics.compute({&one, 1}, options);
    int compared = 0;
    for (int j = 0; j < 500 && compared < targets; ++j) {
      const SurfacePoint b = test::random_point(mesh, random);
      const double d = geodesics.distance(b);
      if (d == kInfinity && longest < 10.0) continue;
      ++compared;
      crossings.clear();
      LocalPathOptions most;
      most.most_windows = 200000;
      const LocalPath path = finder.find(a, b, crossings, most);
      if (d == kInfinity) {
        EXPECT_EQ(path.label, PathLabel::disconnected);
        EXPECT_TRUE(crossings.empty());
        continue;
      }
      ASSERT_TRUE(path.label == PathLabel::shortest || path.label == PathLabel::same_face);
      ASSERT_NEAR(path.length, d, tolerance * size);
      ASSERT_NEAR(test::polyline_length(mesh, a, crossings, b), d, tolerance * size);
      if (tolerance < 1e-9) {
        ASSERT_LT(test::largest_turn(mesh, edges, a, crossings, b), 1e-5);
      }
      // The same pair with next to no work allowed.
      crossings.clear();
      LocalPathOptions least;
      least.most_windows = 1;
      const LocalPath quick = finder.find(a, b, crossings, least);
      ASSERT_NE(quick.label, PathLabel::disconnected);
      ASSERT_GE(quick.length, d - tolerance * size);
      ASSERT_NEAR(test::polyline_length(mesh, a, crossings, b), quick.length, tolerance * size);
      if (tolerance < 1e-9) {
        ASSERT_LT(test::largest_turn(mesh, edges, a, crossings, b), 1e-5)
            << "label " << static_cast<int>(quick.label);
      }
    }
  }
}

TEST(LocalPath, EqualsTheExactDistanceOnBuiltinShapesAndIsStraightEvenWhenItGivesUp) {
  for (const ShapeInfo& shape : builtin_shapes()) {
    SCOPED_TRACE(shape.name);
    ShapeOptions options;
    options.resolution = std::clamp(shape.default_resolution / 4, shape.least_resolution, 5);
    check_pairs(shape.make(options), 11, 4, 8, 100.0, 1e-11);
  }
}

TEST(LocalPath, EqualsTheExactDistanceNearbyOnTheStudysShapes) {
  for (const char* name : {"bunny", "torus", "cube", "trebol", "hand", "fertility"}) {
    const auto mesh = test::study_mesh(name);
    if (!mesh) GTEST_SKIP() << "no study data";
    SCOPED_TRACE(name);
    check_pairs(*mesh, 12, 8, 3, 0.1, 1e-11);
  }
}

TEST(LocalPath, EqualsTheExactDistanceOnNastyMeshes) {
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Random random(seed);
    const TriangleMesh mesh = test::nasty_mesh(random);
    check_pairs(mesh, seed, 1, 5, 100.0, 1e-9);
  }
}

TEST(LocalPath, PointsOfOneFaceAreJoinedByNothing) {
  const TriangleMesh mesh = make_sphere(3);
  const Surface surface = Surface::as_given(mesh);
  const HalfEdges& edges = surface.half_edges();
  LocalPathFinder finder(surface);
  std::vector<Crossing> crossings;
  const LocalPath path = finder.find({5, Vec3(0.2, 0.3, 0.5)}, {5, Vec3(0.6, 0.3, 0.1)}, crossings);
  EXPECT_EQ(path.label, PathLabel::same_face);
  EXPECT_TRUE(crossings.empty());
  // Two corners of one face, named by other faces; and a point with itself.
  const Index v = mesh.face(5)[0];
  const Index w = mesh.face(5)[1];
  EXPECT_EQ(finder.find(vertex_point(edges, v), vertex_point(edges, w), crossings).label,
            PathLabel::same_face);
  EXPECT_EQ(finder.find(vertex_point(edges, v), vertex_point(edges, v), crossings).length, 0.0);
}

TEST(LocalPath, AStraightLineOverTheSharedEdgeOfTwoFacesNeedNotBeShortest) {
  // A deep narrow valley: over its bottom edge it is farther than along the end walls.
  const TriangleMesh box = make_box(1, 1, 1, Vec3(1.0, 0.02, 0.3));
  const Surface surface = Surface::as_given(box);
  ExactGeodesics geodesics(surface);
  LocalPathFinder finder(surface);
  Random random(13);
  std::vector<Crossing> crossings;
  for (int i = 0; i < 300; ++i) {
    const SurfacePoint a = test::random_point(box, random);
    const SurfacePoint b = test::random_point(box, random);
    geodesics.compute(a);
    crossings.clear();
    EXPECT_NEAR(finder.find(a, b, crossings).length, geodesics.distance(b), 1e-12);
  }
}

TEST(LocalPath, AppendsAndDoesNotAllocateAfterWarmUp) {
  const TriangleMesh mesh = make_noisy_cube(8, 0.1, true, 14);
  const Surface surface = Surface::as_given(mesh);
  LocalPathFinder finder(surface);
  std::vector<std::pair<SurfacePoint, SurfacePoint>> pairs;
  Random random(15);
  for (int i = 0; i < 200; ++i)
    pairs.emplace_back(test::random_point(mesh, random), test::random_point(mesh, random));
  std::vector<Crossing> crossings;
  LocalPathOptions options;
  options.most_windows = 300;  // both ways of searching
  std::size_t given_up = 0;
  for (const auto& [a, b] : pairs)
    given_up += finder.find(a, b, crossings, options).label == PathLabel::locally_shortest;
  EXPECT_GT(given_up, 10u);
  EXPECT_LT(given_up, 190u);
  const std::size_t total = crossings.size();
  crossings.clear();
  const long before = mimicry::test::allocation_count();
  for (const auto& [a, b] : pairs) finder.find(a, b, crossings, options);
  EXPECT_EQ(mimicry::test::allocation_count(), before);
  EXPECT_EQ(crossings.size(), total);
}

TEST(LocalPath, BadInputIsNamed) {
  const TriangleMesh mesh = make_grid(2);
  const Surface surface = Surface::as_given(mesh);
  LocalPathFinder finder(surface);
  std::vector<Crossing> crossings;
  const SurfacePoint good{0, Vec3(1, 0, 0)};
  EXPECT_THROW(finder.find(good, {99, Vec3(1, 0, 0)}, crossings), Error);
  EXPECT_THROW(finder.find({0, Vec3(0.5, 0.4, 0.0)}, good, crossings), Error);
  EXPECT_THROW(finder.find(good, {0, Vec3(std::nan(""), 0.5, 0.5)}, crossings), Error);
}

}  // namespace
}  // namespace mimicry
