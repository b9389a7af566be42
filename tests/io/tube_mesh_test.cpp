#include "io/tube_mesh.h"

#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include <mimicry/base/error.h>
#include <mimicry/mesh/half_edges.h>
#include <mimicry/mesh/surface.h>

namespace mimicry {
namespace {

constexpr double kPi = std::numbers::pi;

TubeOptions options_of(double radius, int sides = 12, bool closed = false) {
  TubeOptions options;
  options.radius = radius;
  options.sides = sides;
  options.closed = closed;
  return options;
}

double volume(const TriangleMesh& mesh) {
  double sum = 0.0;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    sum += mesh.corner(f, 0).dot(mesh.corner(f, 1).cross(mesh.corner(f, 2))) / 6.0;
  }
  return sum;
}

void expect_watertight(const TubeMesh& tube) {
  const HalfEdges edges(tube.mesh);
  EXPECT_TRUE(edges.is_manifold());
  for (Index h = 0; h < edges.count(); ++h) ASSERT_TRUE(edges.has_twin(h)) << h;
  ASSERT_EQ(tube.normals.size(), tube.mesh.positions().size());
  for (const Vec3& p : tube.mesh.positions()) ASSERT_TRUE(p.array().isFinite().all());
  for (const Vec3& n : tube.normals) ASSERT_NEAR(n.norm(), 1.0, 1e-12);
}

double distance_to_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const double t = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
  return (p - a - t * (b - a)).norm();
}

double distance(const Vec3& p, const std::vector<Vec3>& line) {
  double best = kInfinity;
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    best = std::min(best, distance_to_segment(p, line[i], line[i + 1]));
  }
  return best;
}

int euler(const TriangleMesh& mesh) {
  return mesh.vertex_count() - mesh.face_count() / 2;  // closed: 3 F = 2 E
}

TEST(TubeMesh, StraightTubeIsAsThickAsAskedAllAlong) {
  const std::vector<Vec3> line = {Vec3(1, 2, 3), Vec3(2, 4, 6), Vec3(3, 6, 9)};
  const TubeMesh tube = tube_mesh(line, options_of(0.25, 64));
  expect_watertight(tube);
  EXPECT_EQ(euler(tube.mesh), 2);
  for (std::size_t v = 0; v < tube.normals.size(); ++v) {
    EXPECT_NEAR(distance(tube.mesh.positions()[v], line), 0.25, 1e-12);
  }
  const double length = (line[2] - line[0]).norm();
  const double exact = kPi * 0.25 * 0.25 * (length + 4.0 / 3.0 * 0.25);
  // A 64-gon has 0.16 % less area than its circle.
  EXPECT_NEAR(volume(tube.mesh), exact, 0.004 * exact);
  EXPECT_LT(volume(tube.mesh), exact);
}

TEST(TubeMesh, NormalsAgreeWithTheFaces) {
  std::vector<Vec3> line;
  for (int i = 0; i <= 60; ++i) {
    const double a = 0.1 * i;
    line.emplace_back(std::cos(a), std::sin(a), 0.2 * a);
  }
  const TubeMesh tube = tube_mesh(line, options_of(0.1, 16));
  expect_watertight(tube);
  const std::vector<Vec3> geometric = angle_weighted_normals(tube.mesh);
  for (std::size_t v = 0; v < geometric.size(); ++v) {
    EXPECT_GT(geometric[v].dot(tube.normals[v]), 0.97) << v;
  }
}

TEST(TubeMesh, GentleBendsThinTheTubeByLessThanAPercent) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(-0.12, 0.12);
  std::vector<Vec3> line = {Vec3::Zero()};
  Vec3 along = Vec3::UnitX();
  for (int i = 0; i < 40; ++i) {
    along = (along + Vec3(uniform(random), uniform(random), uniform(random))).normalized();
    line.push_back(line.back() + 0.5 * along);
  }
  const TubeMesh tube = tube_mesh(line, options_of(0.05));
  for (const Vec3& p : tube.mesh.positions()) {
    EXPECT_LT(distance(p, line), 0.05 * (1.0 + 1e-9));
    EXPECT_GT(distance(p, line), 0.05 * 0.991 - 1e-12);
  }
}

TEST(TubeMesh, SharpBendsAreRoundedOnTheOutside) {
  const std::vector<Vec3> line = {Vec3(-1, 0, 0), Vec3(0, 0, 0), Vec3(0, 1, 0)};
  const TubeMesh tube = tube_mesh(line, options_of(0.1, 24));
  expect_watertight(tube);
  EXPECT_EQ(euler(tube.mesh), 2);
  double reach = 0.0;
  for (const Vec3& p : tube.mesh.positions()) {
    EXPECT_LT(distance(p, line), 0.1 * (1.0 + 1e-9));
    reach = std::max(reach, p.dot(Vec3(1, -1, 0).normalized()));
  }
  EXPECT_NEAR(reach, 0.1, 0.001);  // rings stand at most 15 degrees apart
}

TEST(TubeMesh, ReversalsAndRepeatedPointsGiveNoNanAndNoHole) {
  const Vec3 a(0, 0, 0), b(1, 0, 0), c(0, 1, 0);
  for (const std::vector<Vec3>& line :
       {std::vector<Vec3>{a, b, a}, {a, a, b, b, b, c}, {a, b, a, b, a}, {b, a, b, c, c, a, b}}) {
    for (const bool closed : {false, true}) {
      const TubeMesh tube = tube_mesh(line, options_of(0.1, 8, closed));
      expect_watertight(tube);
      for (const Vec3& p : tube.mesh.positions()) EXPECT_LT(distance(p, {a, b, c, a}), 0.1 + 1e-9);
    }
  }
}

TEST(TubeMesh, OnePointIsABallAndNoneIsEmpty) {
  const std::vector<Vec3> points = {Vec3(1, 2, 3), Vec3(1, 2, 3)};
  const TubeMesh tube = tube_mesh(points, options_of(0.5, 48));
  expect_watertight(tube);
  EXPECT_EQ(euler(tube.mesh), 2);
  for (const Vec3& p : tube.mesh.positions()) EXPECT_NEAR((p - points[0]).norm(), 0.5, 1e-12);
  EXPECT_NEAR(volume(tube.mesh), 4.0 / 3.0 * kPi * 0.125, 0.01);
  EXPECT_EQ(tube_mesh({}, options_of(0.5)).mesh.vertex_count(), 0);
}

TEST(TubeMesh, ClosedTubeIsATorusWithoutASeam) {
  // A closed curve with torsion: parallel transport alone does not come back to where it began.
  std::vector<Vec3> line;
  const int n = 200;
  for (int i = 0; i <= n; ++i) {  // the last point repeats the first
    const double a = 2.0 * kPi * i / n;
    line.emplace_back((2.0 + std::cos(3.0 * a)) * std::cos(2.0 * a), std::sin(3.0 * a),
                      (2.0 + std::cos(3.0 * a)) * std::sin(2.0 * a));
  }
  const int sides = 12;
  const TubeMesh tube = tube_mesh(line, options_of(0.05, sides, true));
  expect_watertight(tube);
  EXPECT_EQ(euler(tube.mesh), 0);
  ASSERT_EQ(tube.mesh.vertex_count(), n * sides);
  EXPECT_GT(volume(tube.mesh), 0.0);
  // From ring to ring a vertex turns about the curve no more at the seam than elsewhere.
  for (Index i = 0; i < n; ++i) {
    const auto at = [&](Index ring) { return static_cast<std::size_t>(ring % n * sides); };
    EXPECT_GT(tube.normals[at(i)].dot(tube.normals[at(i + 1)]), 0.97) << i;
  }
}

TEST(TubeMesh, SizeAndPlaceDoNotMatter) {
  const std::vector<Vec3> line = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(1, 1, 1)};
  const TubeMesh usual = tube_mesh(line, options_of(0.1));
  for (const double scale : {1e-6, 1e6}) {
    std::vector<Vec3> scaled;
    for (const Vec3& p : line) scaled.push_back(scale * p);
    const TubeMesh other = tube_mesh(scaled, options_of(0.1 * scale));
    ASSERT_EQ(other.mesh.vertex_count(), usual.mesh.vertex_count());
    for (Index v = 0; v < usual.mesh.vertex_count(); ++v) {
      EXPECT_LT((other.mesh.position(v) / scale - usual.mesh.position(v)).norm(), 1e-12);
    }
  }
}

TEST(TubeMesh, IsAsThickAsEachPointAsksAndLinearBetweenThem) {
  const std::vector<Vec3> line = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(3, 0, 0)};
  const std::vector<double> radii = {0.1, 0.3, 0.2};
  TubeOptions options = options_of(0.0, 64);  // of a tube without radii of its own
  options.radii = radii;
  const TubeMesh tube = tube_mesh(line, options);
  expect_watertight(tube);
  const auto radius_at = [&](double x) { return x < 1.0 ? 0.1 + 0.2 * x : 0.3 - 0.05 * (x - 1.0); };
  int on_rings = 0;
  for (const Vec3& p : tube.mesh.positions()) {
    const double off = std::hypot(p.y(), p.z());
    // Half a ball at each end.
    if (p.x() < 0.0) {
      EXPECT_NEAR(p.norm(), 0.1, 1e-12);
    }
    if (p.x() > 3.0) {
      EXPECT_NEAR((p - line[2]).norm(), 0.2, 1e-12);
    }
    if (p.x() >= 0.0 && p.x() <= 3.0 && off > 0.09) {
      EXPECT_NEAR(off, radius_at(p.x()), 1e-12);
      ++on_rings;
    }
  }
  EXPECT_EQ(on_rings, 3 * 64);
  // Two frustums and two half balls; a 64-gon has 0.16 % less area than its circle.
  const auto frustum = [](double a, double b, double h) {
    return kPi * h * (a * a + a * b + b * b) / 3.0;
  };
  const double exact =
      frustum(0.1, 0.3, 1.0) + frustum(0.3, 0.2, 2.0) + 2.0 / 3.0 * kPi * (0.001 + 0.008);
  EXPECT_NEAR(volume(tube.mesh), exact, 0.004 * exact);
}

TEST(TubeMesh, AConesNormalsLeanAgainstItsGrowth) {
  std::vector<Vec3> line;
  std::vector<double> radii;
  for (int i = 0; i <= 20; ++i) {
    line.emplace_back(0.1 * i, 0.0, 0.0);
    radii.push_back(0.1 + 0.05 * i);  // half as much as the way
  }
  TubeOptions options = options_of(0.0, 48);
  options.radii = radii;
  const TubeMesh tube = tube_mesh(line, options);
  const std::vector<Vec3> geometric = angle_weighted_normals(tube.mesh);
  int inner = 0;
  for (std::size_t v = 0; v < geometric.size(); ++v) {
    const double x = tube.mesh.positions()[v].x();
    if (x < 0.05 || x > 1.95) continue;
    EXPECT_NEAR(tube.normals[v].x(), -0.5 / std::sqrt(1.25), 1e-9);
    EXPECT_GT(geometric[v].dot(tube.normals[v]), 0.999);
    ++inner;
  }
  EXPECT_EQ(inner, 19 * 48);
}

TEST(TubeMesh, AClosedTubeKeepsItsRadiiAcrossTheSeam) {
  std::vector<Vec3> line;
  std::vector<double> radii;
  for (int i = 0; i <= 40; ++i) {  // the last point repeats the first
    const double a = 2.0 * kPi * i / 40;
    line.emplace_back(std::cos(a), std::sin(a), 0.0);
    radii.push_back(0.1 + 0.05 * std::cos(a));
  }
  TubeOptions options = options_of(0.0, 12, true);
  options.radii = radii;
  const TubeMesh tube = tube_mesh(line, options);
  expect_watertight(tube);
  EXPECT_EQ(euler(tube.mesh), 0);
  for (const Vec3& p : tube.mesh.positions()) {
    const double a = std::atan2(p.y(), p.x());
    EXPECT_NEAR((p - Vec3(std::cos(a), std::sin(a), 0.0)).norm(), 0.1 + 0.05 * std::cos(a), 2e-3);
  }
}

TEST(TubeMesh, RefusesWhatCannotBeMade) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<Vec3> line = {Vec3(0, 0, 0), Vec3(1, 0, 0)};
  EXPECT_THROW(tube_mesh(line, options_of(0.0)), Error);
  EXPECT_THROW(tube_mesh(line, options_of(nan)), Error);
  EXPECT_THROW(tube_mesh(line, options_of(0.1, 2)), Error);
  for (const std::vector<double>& radii :
       {std::vector<double>{0.1}, {0.1, 0.0}, {0.1, nan}, {0.1, 0.1, 0.1}}) {
    TubeOptions options = options_of(0.1);
    options.radii = radii;
    EXPECT_THROW(tube_mesh(line, options), Error);
  }
  EXPECT_THROW(tube_mesh(std::vector<Vec3>{Vec3(0, nan, 0)}, options_of(0.1)), Error);
  EXPECT_THROW(tube_mesh(std::vector<Vec3>{Vec3(0, kInfinity, 0)}, options_of(0.1)), Error);
}

}  // namespace
}  // namespace mimicry
