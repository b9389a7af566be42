#include "mesh/visible_normals.h"

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

#include <mimicry/base/random.h>
#include <mimicry/mesh/shapes.h>
#include <mimicry/mesh/surface.h>

namespace mimicry {
namespace {

double smallest_dot(const Vec3& n, std::span<const Vec3> vectors) {
  double smallest = 2.0;
  for (const Vec3& f : vectors) smallest = std::min(smallest, n.dot(f));
  return smallest;
}

std::vector<std::vector<Vec3>> face_normals_of_vertices(const TriangleMesh& mesh) {
  std::vector<std::vector<Vec3>> rings(static_cast<std::size_t>(mesh.vertex_count()));
  for (Index f = 0; f < mesh.face_count(); ++f)
    for (const Index v : mesh.face(f))
      rings[static_cast<std::size_t>(v)].push_back(face_normal(mesh, f));
  return rings;
}

TEST(MostVisible, KnownOptima) {
  const std::vector<Vec3> axes = {Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()};
  const MostVisible corner = most_visible_direction(axes);
  EXPECT_LT((corner.direction - Vec3::Ones() / std::sqrt(3.0)).norm(), 1e-14);
  EXPECT_NEAR(corner.smallest_dot, 1.0 / std::sqrt(3.0), 1e-14);
  const MostVisible pair = most_visible_direction(std::span(axes).first(2));
  EXPECT_LT((pair.direction - Vec3(1, 1, 0).normalized()).norm(), 1e-14);
  // No direction sees all six sides of a cube; a corner's direction is the least bad.
  std::vector<Vec3> sides = axes;
  for (const Vec3& a : axes) sides.push_back(-a);
  EXPECT_NEAR(most_visible_direction(sides).smallest_dot, -1.0 / std::sqrt(3.0), 1e-14);
  EXPECT_EQ(most_visible_direction({}).direction, Vec3::Zero());
}

TEST(MostVisible, NoDirectionOfAFineSampleIsBetter) {
  Random random(3);
  const auto direction = [&] {
    return Vec3(random.normal(), random.normal(), random.normal()).normalized();
  };
  for (int round = 0; round < 300; ++round) {
    // From narrow cones (below 1) to vectors all around.
    const double spread = random.uniform(0.05, 3.0);
    const Vec3 axis = direction();
    std::vector<Vec3> vectors(1 + random.below(12));
    for (Vec3& v : vectors) v = (axis + spread * direction()).normalized();
    const MostVisible best = most_visible_direction(vectors);
    ASSERT_NEAR(best.direction.norm(), 1.0, 1e-14);
    ASSERT_NEAR(smallest_dot(best.direction, vectors), best.smallest_dot, 1e-14);
    for (int i = 0; i < 1000; ++i) {
      const Vec3 n = (best.direction + random.uniform(0.0, i % 2 ? 3.0 : 0.05) * direction());
      if (n.norm() < 1e-3) continue;
      ASSERT_LE(smallest_dot(n.normalized(), vectors), best.smallest_dot + 1e-12)
          << "round " << round << " of seed 3";
    }
  }
}

TEST(VisibleNormals, SmoothMeshesKeepTheirNormals) {
  for (const std::string_view name : {"sphere", "torus", "rounded-cube", "cube"}) {
    const TriangleMesh mesh = make_shape(name);
    const auto before = angle_weighted_normals(mesh);
    auto after = before;
    make_visible(mesh, HalfEdges(mesh), after);
    EXPECT_TRUE(std::equal(before.begin(), before.end(), after.begin())) << name;
  }
}

TEST(VisibleNormals, EveryVertexSeesItsFacesAsWellAsItCan) {
  const TriangleMesh mesh = make_noisy_cube(16, 0.2, true, 5);
  const auto before = angle_weighted_normals(mesh);
  auto after = before;
  make_visible(mesh, HalfEdges(mesh), after);
  const auto rings = face_normals_of_vertices(mesh);
  int moved = 0, to_the_best = 0;
  for (std::size_t v = 0; v < rings.size(); ++v) {
    const double dot = smallest_dot(after[v], rings[v]);
    ASSERT_NEAR(after[v].norm(), 1.0, 1e-12);
    if (after[v] == before[v]) {
      ASSERT_GE(dot, kVisibleDot - 2e-9) << v;
      continue;
    }
    ++moved;
    const MostVisible best = most_visible_direction(rings[v]);
    ASSERT_NEAR(dot, std::min(kVisibleDot, best.smallest_dot), 1e-9) << v;
    if (best.smallest_dot < kVisibleDot) ++to_the_best;
    // On the arc from the old normal to the best direction.
    ASSERT_NEAR(after[v].dot(before[v].cross(best.direction)), 0.0, 1e-9) << v;
  }
  EXPECT_GT(moved, 50) << "the mesh is not rough enough to test anything";
  EXPECT_GT(to_the_best, 5);
}

}  // namespace
}  // namespace mimicry
