#include "geodesic/fast_marching.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include <mimicry/mesh/shapes.h>

namespace mimicry {
namespace {

struct Errors {
  double mean = 0.0;
  double largest = 0.0;
};

// Relative errors on a sphere from a few sources, leaving out the two edges around each.
Errors sphere_errors(int n) {
  const TriangleMesh mesh = make_sphere(n, 1.0);
  const FastMarching march(mesh);
  FastMarching::Scratch scratch;
  std::vector<double> d(static_cast<std::size_t>(mesh.vertex_count()));
  Errors errors;
  int count = 0;
  for (Index source = 0; source < mesh.vertex_count(); source += mesh.vertex_count() / 7) {
    march.distances(source, d, scratch);
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
      const Vec3& a = mesh.position(source);
      const Vec3& b = mesh.position(v);
      const double exact = std::atan2(a.cross(b).norm(), a.dot(b));
      if (exact < 0.2) continue;
      const double error = std::abs(d[static_cast<std::size_t>(v)] / exact - 1.0);
      errors.mean += error;
      errors.largest = std::max(errors.largest, error);
      ++count;
    }
  }
  errors.mean /= count;
  return errors;
}

TEST(FastMarching, ExactOnThePlane) {
  // The faces unfold flat, so that only the tolerance of corrections (1e-5) and the geometry in
  // single precision remain.
  const TriangleMesh mesh = make_grid(20);
  const FastMarching march(mesh);
  FastMarching::Scratch scratch;
  std::vector<double> d(static_cast<std::size_t>(mesh.vertex_count()));
  for (const Index source : {Index{0}, Index{7}, Index{200}, mesh.vertex_count() - 1}) {
    march.distances(source, d, scratch);
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
      const double exact = (mesh.position(v) - mesh.position(source)).norm();
      EXPECT_NEAR(d[static_cast<std::size_t>(v)], exact, 2e-4 * exact) << source << " to " << v;
    }
  }
}

TEST(FastMarching, ConvergesOnTheSphere) {
  const Errors coarse = sphere_errors(6);
  const Errors fine = sphere_errors(24);
  RecordProperty("mean_percent_coarse", std::to_string(100 * coarse.mean));
  RecordProperty("mean_percent_fine", std::to_string(100 * fine.mean));
  EXPECT_LT(coarse.mean, 0.015);
  EXPECT_LT(fine.mean, 0.003);
  EXPECT_LT(fine.mean, 0.5 * coarse.mean);
  EXPECT_LT(fine.largest, 0.02);
}

TEST(FastMarching, NearlySymmetric) {
  const TriangleMesh mesh = make_torus(40, 20);
  const FastMarching march(mesh);
  FastMarching::Scratch scratch;
  const auto count = static_cast<std::size_t>(mesh.vertex_count());
  std::vector<double> from_first(count), from_other(count);
  march.distances(0, from_first, scratch);
  for (std::size_t v = 37; v < count; v += 97) {
    march.distances(static_cast<Index>(v), from_other, scratch);
    EXPECT_NEAR(from_other[0], from_first[v], 0.03 * from_first[v]);
  }
}

TEST(FastMarching, ScaleOfTheModelDoesNotMatter) {
  const TriangleMesh mesh = make_sphere(4, 1.0);
  FastMarching::Scratch scratch;
  const auto count = static_cast<std::size_t>(mesh.vertex_count());
  std::vector<double> d(count), scaled(count);
  FastMarching(mesh).distances(3, d, scratch);
  for (const double scale : {1e-6, 1e6}) {
    FastMarching(make_sphere(4, scale)).distances(3, scaled, scratch);
    for (std::size_t v = 0; v < count; ++v) EXPECT_NEAR(scaled[v], scale * d[v], 1e-4 * scale);
  }
}

TEST(FastMarching, OtherComponentsAreOutOfReach) {
  const TriangleMesh mesh = make_two_spheres(3);
  const FastMarching march(mesh);
  FastMarching::Scratch scratch;
  std::vector<double> d(static_cast<std::size_t>(mesh.vertex_count()));
  march.distances(0, d, scratch);
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    const bool same = mesh.position(v).x() * mesh.position(0).x() > 0.0;
    EXPECT_EQ(d[static_cast<std::size_t>(v)] < kInfinity, same);
  }
}

TEST(FastMarching, FacesWithoutAreaAreCrossed) {
  // A row of squares of which one is folded to a line: lengths along it still count.
  const std::vector<Vec3> p = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {1, 1, 0}, {1, 0, 0}};
  const TriangleMesh mesh(p, {{0, 1, 4}, {1, 2, 3}, {1, 5, 2}, {1, 1, 2}});
  const FastMarching march(mesh);
  FastMarching::Scratch scratch;
  std::vector<double> d(p.size());
  march.distances(0, d, scratch);
  const std::vector<double> expected = {0, 1, 2, 3, std::sqrt(2.0), 1};
  for (std::size_t v = 0; v < p.size(); ++v) EXPECT_NEAR(d[v], expected[v], 1e-6);
}

TEST(FastMarching, LoweringGivesTheNearestSource) {
  const TriangleMesh mesh = make_sphere(8, 1.0);
  const FastMarching march(mesh);
  FastMarching::Scratch scratch;
  const auto count = static_cast<std::size_t>(mesh.vertex_count());
  std::vector<double> nearest(count, kInfinity), d(count), expected(count, kInfinity);
  for (std::size_t source = 0; source < count; source += count / 9) {
    march.lower(static_cast<Index>(source), nearest, scratch);
    march.distances(static_cast<Index>(source), d, scratch);
    for (std::size_t v = 0; v < count; ++v) expected[v] = std::min(expected[v], d[v]);
  }
  // Where two sources compete the front of the later one stops early: edges instead of faces.
  for (std::size_t v = 0; v < count; ++v) {
    EXPECT_GE(nearest[v], 0.97 * expected[v]);
    EXPECT_LE(nearest[v], 1.08 * expected[v]);
  }
}

}  // namespace
}  // namespace mimicry
