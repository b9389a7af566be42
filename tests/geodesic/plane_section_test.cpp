#include <cmath>

#include <gtest/gtest.h>

#include <mimicry/geodesic/plane_section.h>

namespace mimicry::geodesic {
namespace {

// n x n squares of side 1 / n in the plane z = height(x, y), each cut along its diagonal.
template <class Height>
TriangleMesh grid(int n, Height&& height) {
  std::vector<Vec3> positions;
  std::vector<Face> faces;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) {
      const double x = double(i) / n;
      const double y = double(j) / n;
      positions.emplace_back(x, y, height(x, y));
    }
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const Index a = j * (n + 1) + i;
      faces.push_back({a, a + 1, a + n + 2});
      faces.push_back({a, a + n + 2, a + n + 1});
    }
  return {positions, faces};
}

SurfacePoint locate(const TriangleMesh& mesh, int n, double x, double y) {
  const int i = std::min(int(x * n), n - 1);
  const int j = std::min(int(y * n), n - 1);
  const double u = x * n - i;
  const double v = y * n - j;
  const Index square = 2 * (j * n + i);
  (void)mesh;
  return u >= v ? SurfacePoint{square, Vec3(1 - u, u - v, v)}
                : SurfacePoint{square + 1, Vec3(1 - v, u, v - u)};
}

TEST(PlaneSection, StraightOnAPlaneAndEveryEdgeCrossedOnTheLine) {
  const int n = 8;
  const TriangleMesh mesh = grid(n, [](double, double) { return 0.0; });
  const HalfEdges edges(mesh);
  const auto from = locate(mesh, n, 0.07, 0.11);
  const auto to = locate(mesh, n, 0.93, 0.64);
  std::vector<Crossing> crossings;
  const PlaneSection section = trace_plane_section(mesh, edges, from, to, Vec3::UnitZ(), crossings);
  ASSERT_TRUE(section.found);
  const Vec3 a = mesh.position(from);
  const Vec3 b = mesh.position(to);
  EXPECT_NEAR(section.length, (b - a).norm(), 1e-14);
  // Seven vertical and five horizontal grid lines, and the diagonals between.
  EXPECT_GE(crossings.size(), 12u);
  double along = 0.0;
  for (const Crossing& c : crossings) {
    const Vec3 x = position(mesh, c);
    EXPECT_LT((x - a).cross(b - a).norm(), 1e-14);
    EXPECT_GE((x - a).dot(b - a), along);
    along = (x - a).dot(b - a);
  }
}

TEST(PlaneSection, NeighbouringCrossingsShareAFace) {
  const int n = 16;
  const TriangleMesh mesh =
      grid(n, [](double x, double y) { return 0.2 * std::sin(7 * x) * std::cos(5 * y); });
  const HalfEdges edges(mesh);
  std::vector<Crossing> crossings;
  const auto from = locate(mesh, n, 0.11, 0.83);
  const auto to = locate(mesh, n, 0.81, 0.17);
  ASSERT_TRUE(trace_plane_section(mesh, edges, from, to, Vec3::UnitZ(), crossings).found);
  Index face = from.face;
  for (const Crossing& c : crossings) {
    ASSERT_EQ(HalfEdges::face(c.half_edge), face)
        << "a crossing is named from the face that is left";
    face = HalfEdges::face(edges.twin(c.half_edge));
  }
  EXPECT_EQ(face, to.face);
}

TEST(PlaneSection, PointsOnVerticesAndEdgesAreJoined) {
  const int n = 4;
  const TriangleMesh mesh = grid(n, [](double, double) { return 0.0; });
  const HalfEdges edges(mesh);
  // Every pair of vertices, each named by whichever face comes first: many sections run along
  // edges.
  for (Index v = 0; v < mesh.vertex_count(); ++v)
    for (Index w = 0; w < mesh.vertex_count(); ++w) {
      if (v == w) continue;
      const SurfacePoint from = surface_point(Crossing{edges.outgoing(v), 0.0});
      const SurfacePoint to = surface_point(Crossing{edges.outgoing(w), 0.0});
      std::vector<Crossing> crossings;
      const PlaneSection section =
          trace_plane_section(mesh, edges, from, to, Vec3::UnitZ(), crossings);
      // A section that leaves through the rim (along it) is allowed to fail.
      const Vec3 a = mesh.position(v);
      const Vec3 b = mesh.position(w);
      const bool on_rim = (a.x() == b.x() && (a.x() == 0 || a.x() == 1)) ||
                          (a.y() == b.y() && (a.y() == 0 || a.y() == 1));
      if (on_rim) continue;
      ASSERT_TRUE(section.found) << v << " to " << w;
      EXPECT_NEAR(section.length, (b - a).norm(), 1e-13);
    }
}

TEST(PlaneSection, AcrossAGapItIsNotFoundAndLeavesNothingBehind) {
  const TriangleMesh two(
      {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(2, 0, 0), Vec3(3, 0, 0), Vec3(2, 1, 0)},
      {{0, 1, 2}, {3, 4, 5}});
  std::vector<Crossing> crossings(1);
  const Vec3 middle = Vec3::Constant(1.0 / 3);
  EXPECT_FALSE(
      trace_plane_section(two, HalfEdges(two), {0, middle}, {1, middle}, Vec3::UnitZ(), crossings)
          .found);
  EXPECT_EQ(crossings.size(), 1u);
}

TEST(PlaneSection, UndefinedPlaneIsNotFound) {
  const int n = 4;
  const TriangleMesh mesh = grid(n, [](double, double) { return 0.0; });
  std::vector<Crossing> crossings;
  const auto from = locate(mesh, n, 0.1, 0.1);
  const auto to = locate(mesh, n, 0.9, 0.1);
  EXPECT_FALSE(
      trace_plane_section(mesh, HalfEdges(mesh), from, to, Vec3::UnitX(), crossings).found);
}

}  // namespace
}  // namespace mimicry::geodesic
