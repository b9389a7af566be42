#include "bake/samples.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include <mimicry/mesh/shapes.h>

namespace mimicry {
namespace {

TEST(Samples, AreSpreadEvenly) {
  const TriangleMesh mesh = make_sphere(10, 1.0);
  const FastMarching march(mesh);
  const std::vector<Index> samples = farthest_points(mesh, march, 60);
  ASSERT_EQ(samples.size(), 60u);
  // Farthest points are apart at least as far as every vertex is from the nearest of them, up to
  // the error of the distances.
  double apart = kInfinity, cover = 0.0;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    double nearest = kInfinity;
    for (const Index s : samples) {
      const double d = (mesh.position(v) - mesh.position(s)).norm();
      if (s != v) {
        nearest = std::min(nearest, d);
        if (std::find(samples.begin(), samples.end(), v) != samples.end())
          apart = std::min(apart, d);
      } else {
        nearest = 0.0;
        break;
      }
    }
    cover = std::max(cover, nearest);
  }
  EXPECT_GT(apart, 0.9 * cover);
}

TEST(Samples, AllVerticesWhereThereAreFewer) {
  const TriangleMesh mesh = make_two_spheres(2);
  const FastMarching march(mesh);
  std::vector<Index> samples = farthest_points(mesh, march, 1000);
  std::sort(samples.begin(), samples.end());
  ASSERT_EQ(static_cast<Index>(samples.size()), mesh.vertex_count());
  EXPECT_EQ(std::adjacent_find(samples.begin(), samples.end()), samples.end());
}

TEST(Samples, EveryComponentGetsOneFirstAndLonelyVerticesNone) {
  const TriangleMesh spheres = make_two_spheres(3);
  std::vector<Vec3> positions(spheres.positions().begin(), spheres.positions().end());
  positions.emplace_back(9.0, 9.0, 9.0);
  const TriangleMesh mesh(positions, {spheres.faces().begin(), spheres.faces().end()});
  const FastMarching march(mesh);
  const std::vector<Index> samples = farthest_points(mesh, march, 2);
  ASSERT_EQ(samples.size(), 2u);
  EXPECT_LT(mesh.position(samples[0]).x() * mesh.position(samples[1]).x(), 0.0);
  const std::vector<Index> all = farthest_points(mesh, march, 100000);
  EXPECT_EQ(std::count(all.begin(), all.end(), mesh.vertex_count() - 1), 0);
}

TEST(SampleDistances, GeodesicWithinAndStraightBetweenComponents) {
  const TriangleMesh mesh = make_two_spheres(8);
  const FastMarching march(mesh);
  const std::vector<Index> samples = farthest_points(mesh, march, 24);
  Executor one(1), two(2);
  const Eigen::MatrixXd d = sample_distances(mesh, march, samples, one);
  EXPECT_TRUE(d == d.transpose());
  EXPECT_TRUE(d == sample_distances(mesh, march, samples, two));
  for (Eigen::Index i = 0; i < d.rows(); ++i)
    for (Eigen::Index j = 0; j < d.rows(); ++j) {
      const Vec3& a = mesh.position(samples[static_cast<std::size_t>(i)]);
      const Vec3& b = mesh.position(samples[static_cast<std::size_t>(j)]);
      if (a.x() * b.x() < 0.0) {
        EXPECT_EQ(d(i, j), (a - b).norm());
        continue;
      }
      const Vec3 centre(a.x() < 0.0 ? -0.55 : 0.55, 0.0, 0.0);
      const Vec3 u = a - centre, v = b - centre;
      const double arc = 0.45 * std::atan2(u.cross(v).norm(), u.dot(v));
      // Fast marching on a sphere of this resolution is off by up to about 3 %.
      EXPECT_NEAR(d(i, j), arc, 0.03 * arc + 1e-12);
    }
}

}  // namespace
}  // namespace mimicry
