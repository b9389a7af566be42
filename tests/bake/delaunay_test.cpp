#include "bake/delaunay.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <random>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "base/compiler.h"

namespace mimicry {
namespace {

constexpr std::int32_t kTop = (1 << kGridBits) - 1;

std::vector<GridPoint> random_points(int count, std::int32_t top, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_int_distribution<std::int32_t> coordinate(0, top);
  std::vector<GridPoint> points(static_cast<std::size_t>(count));
  for (GridPoint& p : points) p = {coordinate(random), coordinate(random), coordinate(random)};
  return points;
}

// Sixfold volume, exact.
Int128 volume(const GridPoint& a, const GridPoint& b, const GridPoint& c, const GridPoint& d) {
  Int128 m[3][3];
  for (std::size_t k = 0; k < 3; ++k) {
    m[0][k] = b[k] - a[k];
    m[1][k] = c[k] - a[k];
    m[2][k] = d[k] - a[k];
  }
  return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
         m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
         m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

// Everything that makes it the Delaunay triangulation of its points, by definition.
void expect_delaunay(const Delaunay& d, bool all_spheres = true) {
  const std::vector<Tet> tets = d.tets();
  std::map<std::array<Index, 3>, int> faces;
  for (const Tet& t : tets) {
    ASSERT_GT(volume(d.point(t[0]), d.point(t[1]), d.point(t[2]), d.point(t[3])), 0);
    for (std::size_t k = 0; k < 4; ++k) {
      std::array<Index, 3> f = {t[(k + 1) % 4], t[(k + 2) % 4], t[(k + 3) % 4]};
      std::sort(f.begin(), f.end());
      ASSERT_LE(++faces[f], 2);
    }
    if (!all_spheres) continue;
    for (Index v = 0; v < d.vertex_count(); ++v)
      ASSERT_LE(in_sphere(d.point(t[0]), d.point(t[1]), d.point(t[2]), d.point(t[3]), d.point(v)),
                0)
          << "vertex " << v;
  }
  for (Index c = 0; c < d.cell_count(); ++c) {
    if (!d.is_tet(c)) continue;
    for (std::size_t k = 0; k < 4; ++k) {
      const auto& back = d.cell(d.cell(c).n[k]).n;
      ASSERT_NE(std::find(back.begin(), back.end(), c), back.end());
    }
  }
}

double total_volume(const Delaunay& d) {
  double sum = 0.0;
  for (const Tet& t : d.tets())
    sum += static_cast<double>(volume(d.point(t[0]), d.point(t[1]), d.point(t[2]), d.point(t[3])));
  return sum / 6.0;
}

TEST(DelaunayPredicates, SignsOfKnownPlaces) {
  const GridPoint a = {0, 0, 0}, b = {kTop, 0, 0}, c = {0, kTop, 0}, d = {0, 0, kTop};
  EXPECT_EQ(orientation(a, b, c, d), 1);
  EXPECT_EQ(orientation(a, c, b, d), -1);
  EXPECT_EQ(orientation(a, b, c, {kTop, kTop, 0}), 0);
  EXPECT_EQ(in_sphere(a, b, c, d, {1, 1, 1}), 1);
  EXPECT_EQ(in_sphere(a, b, c, d, {kTop, kTop, kTop}), 0);
  EXPECT_EQ(in_sphere(a, b, c, d, {kTop, kTop, kTop - 1}), 1);
  const GridPoint near = {kTop - 1, 0, 0};
  EXPECT_EQ(in_sphere(a, near, c, d, b), -1);
}

TEST(DelaunayPredicates, OrientationEqualsTheExactVolume) {
  // Nearly coplanar quadruples, where the filter must give way to integers.
  std::mt19937 random(5);
  std::uniform_int_distribution<std::int32_t> far(0, kTop / 2), near(-2, 2);
  for (int k = 0; k < 20000; ++k) {
    GridPoint a, b, c, d;
    for (std::size_t i = 0; i < 3; ++i) {
      a[i] = far(random);
      b[i] = far(random);
      c[i] = far(random);
      d[i] = std::clamp((a[i] + b[i] + c[i]) / 3 + near(random), 0, kTop);
    }
    const Int128 exact = volume(a, b, c, d);
    ASSERT_EQ(orientation(a, b, c, d), (exact > 0) - (exact < 0)) << "round " << k;
  }
}

TEST(Delaunay, RandomPointsHaveEmptySpheres) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    SCOPED_TRACE(seed);
    Delaunay d;
    d.insert(random_points(200, kTop, seed));
    expect_delaunay(d);
  }
}

TEST(Delaunay, PointsInBatchesHaveEmptySpheres) {
  Delaunay d;
  const std::vector<GridPoint> points = random_points(240, kTop, 7);
  for (std::size_t k = 0; k < points.size(); k += 40) d.insert(std::span(points).subspan(k, 40));
  expect_delaunay(d);
}

TEST(Delaunay, CrowdedGridPointsAndDuplicates) {
  // 300 points on 6^3 places: duplicates, collinear, coplanar and cospherical all at once.
  for (unsigned seed = 1; seed <= 5; ++seed) {
    SCOPED_TRACE(seed);
    Delaunay d;
    const std::vector<GridPoint> points = random_points(300, 5, seed);
    const std::vector<Index> numbers = d.insert(points);
    for (std::size_t k = 0; k < points.size(); ++k) {
      EXPECT_EQ(d.point(numbers[k]), points[k]);
    }
    std::set<Index> distinct(numbers.begin(), numbers.end());
    std::set<GridPoint> places(points.begin(), points.end());
    EXPECT_EQ(distinct.size(), places.size());
    expect_delaunay(d);
  }
}

TEST(Delaunay, FullLatticeFillsItsCube) {
  std::vector<GridPoint> points;
  for (std::int32_t x = 0; x < 7; ++x)
    for (std::int32_t y = 0; y < 7; ++y)
      for (std::int32_t z = 0; z < 7; ++z) points.push_back({x * 1000, y * 1000, z * 1000});
  Delaunay d;
  d.insert(points);
  expect_delaunay(d);
  EXPECT_EQ(total_volume(d), 6000.0 * 6000.0 * 6000.0);
}

TEST(Delaunay, CosphericalPoints) {
  // Signed permutations of (0, 7, 24), (15, 20, 0), (12, 9, 20) ...: all at distance 25 of a
  // centre.
  std::vector<GridPoint> points;
  for (std::int32_t x = -25; x <= 25; ++x)
    for (std::int32_t y = -25; y <= 25; ++y)
      for (std::int32_t z = -25; z <= 25; ++z)
        if (x * x + y * y + z * z == 625) points.push_back({x + 30, y + 30, z + 30});
  ASSERT_GT(points.size(), 50u);
  Delaunay d;
  d.insert(points);
  expect_delaunay(d);
  points.assign(1, {30, 30, 30});
  d.insert(points);
  expect_delaunay(d);
}

TEST(Delaunay, APointAmongThousandsAroundIt) {
  // Points on a sphere, its centre last: the cavity's hull has them all. A table of pairs of them
  // would take 100 MB.
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  std::vector<GridPoint> points;
  for (int k = 0; k < 5000; ++k) {
    double d[3] = {normal(random), normal(random), normal(random)};
    const double size = std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    GridPoint p;
    for (std::size_t i = 0; i < 3; ++i)
      p[i] = static_cast<std::int32_t>((0.5 + 0.45 * d[i] / size) * kTop);
    points.push_back(p);
  }
  Delaunay d;
  d.insert(points);
  const std::vector<Index> centre =
      d.insert(std::vector<GridPoint>{{kTop / 2, kTop / 2, kTop / 2}});
  expect_delaunay(d, false);
  std::size_t joined = 0;
  for (Index v = 0; v < centre[0]; ++v) joined += d.has_edge(v, centre[0]);
  EXPECT_GT(joined, 4900u);
  EXPECT_FALSE(d.has_edge(0, 1));
}

TEST(Delaunay, FlatInputHasNoTetrahedraUntilAPointLeavesThePlane) {
  Delaunay d;
  std::vector<GridPoint> points;
  for (std::int32_t x = 0; x < 10; ++x)
    for (std::int32_t y = 0; y < 10; ++y) points.push_back({x, y, x + y});
  d.insert(points);
  EXPECT_TRUE(d.tets().empty());
  points.assign(1, {4, 4, 100});
  d.insert(points);
  EXPECT_FALSE(d.tets().empty());
  expect_delaunay(d);
  Delaunay line;
  line.insert(std::vector<GridPoint>{{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {3, 3, 3}, {3, 3, 3}});
  EXPECT_TRUE(line.tets().empty());
}

TEST(Delaunay, EdgesAndFacesAreFound) {
  Delaunay d;
  d.insert(random_points(60, kTop, 3));
  std::set<std::pair<Index, Index>> edges;
  for (const Tet& t : d.tets()) {
    for (const Index a : t)
      for (const Index b : t)
        if (a != b) edges.insert({a, b});
    EXPECT_TRUE(d.has_face(t[0], t[1], t[2]));
    EXPECT_TRUE(d.has_face(t[3], t[1], t[0]));
  }
  for (Index a = 0; a < 60; ++a)
    for (Index b = 0; b < 60; ++b)
      if (a != b) {
        EXPECT_EQ(d.has_edge(a, b), edges.contains({a, b}));
      }
}

TEST(Delaunay, SameInputSameTetrahedra) {
  Delaunay a, b;
  a.insert(random_points(500, 40, 11));
  b.insert(random_points(500, 40, 11));
  EXPECT_EQ(a.tets(), b.tets());
  expect_delaunay(a, false);
}

}  // namespace
}  // namespace mimicry
