#include <cmath>
#include <functional>
#include <numbers>
#include <queue>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <mimicry/base/error.h>
#include <mimicry/geodesic/exponential_map.h>
#include <mimicry/mesh/shapes.h>
#include <mimicry/mesh/surface.h>

#include "geodesic/support.h"
#include "messy/messy_meshes.h"

namespace mimicry {
namespace {

TEST(ExponentialMap, ExactOnAPlane) {
  const TriangleMesh mesh = make_grid(10);
  const Surface surface = Surface::as_given(mesh);
  const std::vector<Vec3> normals = angle_weighted_normals(mesh);
  DiscreteExponentialMap map(surface);
  Random random(1);
  for (int i = 0; i < 30; ++i) {
    const SurfacePoint p = test::random_point(mesh, random);
    const ExponentialPatch& patch = map.compute(p, 0.5, Vec3(1, 2, 3));
    std::size_t expected = 0;
    for (Index v = 0; v < mesh.vertex_count(); ++v)
      expected += (mesh.position(v) - mesh.position(p)).norm() <= 0.5 - 1e-9;
    EXPECT_EQ(patch.vertices.size(), expected);
    for (std::size_t k = 0; k < patch.vertices.size(); ++k) {
      const Vec3 d = mesh.position(patch.vertices[k]) - patch.origin;
      ASSERT_LT((patch.coordinates[k] - Vec2(d.dot(patch.x_axis), d.dot(patch.y_axis))).norm(),
                1e-12);
    }
  }
}

// Largest distance between the map and exact polar coordinates on a sphere, within `radius`.
double sphere_error(int n, double radius) {
  const TriangleMesh mesh = make_sphere(n);
  const Surface surface = Surface::as_given(mesh);
  const HalfEdges& edges = surface.half_edges();
  DiscreteExponentialMap map(surface);
  Random random(2);
  double worst = 0.0;
  for (int i = 0; i < 10; ++i) {
    const auto v =
        static_cast<Index>(random.below(static_cast<std::uint32_t>(mesh.vertex_count())));
    const ExponentialPatch& patch = map.compute(vertex_point(edges, v), radius);
    const Vec3 c = mesh.position(v);
    for (std::size_t k = 0; k < patch.vertices.size(); ++k) {
      const Vec3& x = mesh.position(patch.vertices[k]);
      const Vec3 side = x - x.dot(c) * c;
      if (side.norm() < 1e-9) continue;
      const Vec3 exact = test::angle_between(c, x) * side.normalized();
      const Vec2 flat(exact.dot(patch.x_axis), exact.dot(patch.y_axis));
      worst = std::max(worst, (patch.coordinates[k] - flat).norm());
    }
  }
  return worst;
}

TEST(ExponentialMap, NearExactPolarCoordinatesOnASphere) {
  // A patch of radius 1 reaches nearly a third of the way around.
  const double coarse = sphere_error(8, 1.0);
  const double fine = sphere_error(32, 1.0);
  EXPECT_LT(coarse, 0.04);
  EXPECT_LT(fine, 0.45 * coarse);
}

TEST(ExponentialMap, NearTheUnrolledCylinder) {
  const TriangleMesh mesh = make_cylinder(10);
  const Surface surface = Surface::as_given(mesh);
  const HalfEdges& edges = surface.half_edges();
  const std::vector<Vec3> normals = angle_weighted_normals(mesh);
  DiscreteExponentialMap map(surface);
  Index v = 0;  // on the side, half way up
  for (Index w = 0; w < mesh.vertex_count(); ++w) {
    const auto off = [&](Index u) {
      const Vec3& p = mesh.position(u);
      return std::abs(p.y()) + std::abs(std::hypot(p.x(), p.z()) - kCylinderRadius);
    };
    if (off(w) < off(v)) v = w;
  }
  const Vec3 c = mesh.position(v);
  // Up to a quarter around: past a right angle of the normals.
  const ExponentialPatch& patch = map.compute(vertex_point(edges, v), 0.9, Vec3::UnitY());
  EXPECT_LT((patch.x_axis - Vec3::UnitY()).norm(), 1e-6);
  EXPECT_GT(patch.vertices.size(), 100u);
  for (std::size_t k = 0; k < patch.vertices.size(); ++k) {
    const Vec3& x = mesh.position(patch.vertices[k]);
    const double turn = std::atan2(x.z(), x.x()) - std::atan2(c.z(), c.x());
    const double around = kCylinderRadius * std::remainder(turn, 2 * std::numbers::pi);
    const Vec3 east = Vec3(-c.z(), 0, c.x()).normalized();
    const Vec2 exact(x.y() - c.y(), around * east.dot(patch.y_axis));
    // Polygons cut arcs short by a factor of 1 - (pi / 60)^2 / 6.
    ASSERT_LT((patch.coordinates[k] - exact).norm(), 0.01) << patch.vertices[k];
  }
}

TEST(ExponentialMap, NastyMeshesGiveNoNaNAndBadInputIsNamed) {
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    Random random(seed);
    const TriangleMesh mesh = test::nasty_mesh(random);
    DiscreteExponentialMap map(Surface::as_given(mesh));
    const ExponentialPatch& patch = map.compute(test::random_point(mesh, random), 2.0);
    for (const Vec2& x : patch.coordinates) ASSERT_TRUE(x.allFinite()) << "seed " << seed;
  }
  const TriangleMesh mesh = make_grid(2);
  const Surface surface = Surface::as_given(mesh);
  const std::vector<Vec3> normals = angle_weighted_normals(mesh);
  DiscreteExponentialMap map(surface);
  EXPECT_THROW(map.compute({0, Vec3(1, 1, 0)}, 1.0), Error);
  EXPECT_THROW(map.compute({0, Vec3(1, 0, 0)}, 0.0), Error);
  EXPECT_THROW(map.compute({0, Vec3(1, 0, 0)}, std::nan("")), Error);
}

// Lengths of the shortest ways along edges (Dijkstra 1959) from a point, by the fans that the map
// sees; the first step is straight, to the corners of the faces that the point is on.
std::vector<double> ways_along_edges(const TriangleMesh& mesh, const HalfEdges& edges,
                                     const SurfacePoint& p) {
  std::vector<double> way(static_cast<std::size_t>(mesh.vertex_count()), kInfinity);
  using Entry = std::pair<double, Index>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  const auto offer = [&](Index v, double length) {
    if (length >= way[static_cast<std::size_t>(v)]) return;
    way[static_cast<std::size_t>(v)] = length;
    queue.emplace(length, v);
  };
  for (const Index v : mesh.face(p.face)) offer(v, (mesh.position(v) - mesh.position(p)).norm());
  while (!queue.empty()) {
    const double length = queue.top().first;
    const Index v = queue.top().second;
    queue.pop();
    if (length > way[static_cast<std::size_t>(v)]) continue;
    const auto step = [&](Index u) {
      offer(u, length + (mesh.position(u) - mesh.position(v)).norm());
    };
    const Index first = edges.outgoing(v);
    if (first < 0) continue;
    Index h = first, last = first;
    do {
      step(edges.head(h));
      last = h;
      h = edges.ccw(h);
    } while (h >= 0 && h != first);
    if (h < 0) step(edges.tail(HalfEdges::previous(last)));
  }
  return way;
}

void expect_within_bounds(const TriangleMesh& mesh, std::uint64_t seed, std::size_t& looked_at) {
  SCOPED_TRACE("seed " + std::to_string(seed));
  const Surface surface = Surface::as_given(mesh);
  const HalfEdges& edges = surface.half_edges();
  DiscreteExponentialMap map(surface);
  Random random(seed);
  for (int i = 0; i < 5; ++i) {
    const SurfacePoint p = test::random_point(mesh, random);
    const std::vector<double> ways = ways_along_edges(mesh, edges, p);
    const ExponentialPatch& patch = map.compute(p, kInfinity);
    const double size = diagonal(mesh);
    for (std::size_t k = 0; k < patch.vertices.size(); ++k) {
      const double length = patch.coordinates[k].norm();
      const Index v = patch.vertices[k];
      // The map leaves alone what is within 1e-9 of a bound.
      const double straight = (mesh.position(v) - mesh.position(p)).norm();
      ASSERT_GE(length, (1.0 - 2e-9) * straight - 1e-14 * size) << "vertex " << v;
      ASSERT_LE(length, (1.0 + 2e-9) * ways[static_cast<std::size_t>(v)] + 1e-14 * size)
          << "vertex " << v;
      ++looked_at;
    }
  }
}

TEST(ExponentialMap, LengthsAreBetweenTheStraightLineAndTheWayAlongEdges) {
  std::size_t looked_at = 0;
  for (const messy::Family& family : messy::families()) {
    SCOPED_TRACE(family.name);
    expect_within_bounds(family.make(500, 3), 3, looked_at);
  }
  for (std::uint64_t seed = 0; seed < 500; ++seed) {
    Random random(seed);
    std::vector<std::uint8_t> bytes(200);
    for (std::uint8_t& b : bytes) b = static_cast<std::uint8_t>(random.bits());
    expect_within_bounds(messy::of_bytes(bytes), seed, looked_at);
  }
  EXPECT_GT(looked_at, 20000u);
}

}  // namespace
}  // namespace mimicry
