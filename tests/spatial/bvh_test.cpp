#include "spatial/bvh.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <mimicry/mesh/shapes.h>

#include "spatial/brute_force.h"
#include "spatial/meshes.h"
#include "spatial/surface_search.h"

namespace mimicry {
namespace {

using test::Random;
using test::uniform;
using test::uniform_vector;
using test::unit_vector;

struct Named {
  std::string name;
  TriangleMesh mesh;
};

std::vector<Named> meshes() {
  Random random(7);
  std::vector<Named> result;
  result.push_back({"torus", make_torus(40, 20, 1.0, 0.4)});
  result.push_back({"cube", make_box(6, 6, 6, Vec3::Ones())});
  result.push_back({"soup", test::soup(random, 500)});
  result.push_back({"two parts", test::joined(make_box(3, 3, 3, Vec3::Ones()),
                                              test::transformed(make_torus(20, 9, 1.0, 0.4), 0.3,
                                                                Vec3(4, 0, 0)))});
  result.push_back({"one triangle", {{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)}, {{0, 1, 2}}}});
  // Every centre is the same: nothing to split by.
  std::vector<Vec3> corners;
  std::vector<Face> faces;
  for (Index i = 0; i < 300; ++i) {
    corners.insert(corners.end(), {Vec3(2, -1, 0), Vec3(-2, -1, 0), Vec3(0, 2, 0)});
    faces.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  result.push_back({"stack", {corners, faces}});
  // Sizes over twelve decades, one inside the other.
  corners.clear();
  faces.clear();
  for (Index i = 0; i < 120; ++i) {
    const double s = std::pow(10.0, -0.1 * i);
    corners.insert(corners.end(), {Vec3(s, 0, s), Vec3(0, s, s), Vec3(s, s, 0)});
    faces.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  result.push_back({"nested", {corners, faces}});
  return result;
}

struct Both {
  TriangleMesh mesh;
  Bvh<3, Triangle> bvh;
  BruteForce<3, Triangle> brute;

  explicit Both(TriangleMesh m) : mesh(std::move(m)) {
    bvh = {mesh.face_count(), get()};
    brute = {mesh.face_count(), get()};
  }
  std::function<Triangle(Index)> get() const {
    return [this](Index f) { return test::triangle_of(mesh, f); };
  }

  void expect_same(const Vec3& y, double bound2, Index hint, const std::string& where) const {
    const NearestTriangle a = nearest_triangle(bvh, y, bound2, hint, get());
    const NearestTriangle b = nearest_triangle(brute, y, bound2, kNone, get());
    ASSERT_EQ(a.surface.face, b.surface.face) << where << " at " << y.transpose();
    ASSERT_EQ(a.distance2, b.distance2) << where;
    ASSERT_EQ(a.surface.bary, b.surface.bary) << where;
  }
  void expect_same_ray(const Vec3& origin, const Vec3& direction, const std::string& where) const {
    const Ray ray(origin, direction);
    const TriangleOnRay a = first_on_ray(bvh, ray);
    const TriangleOnRay b = first_on_ray(brute, ray);
    ASSERT_EQ(a.surface.face, b.surface.face)
        << where << " from " << origin.transpose() << " to " << direction.transpose();
    ASSERT_EQ(a.t, b.t) << where;
    ASSERT_EQ(a.surface.bary, b.surface.bary) << where;
    double sum_a = 0.0, sum_b = 0.0;
    int count_a = 0, count_b = 0;
    each_on_ray(bvh, ray, [&](const TriangleOnRay& h) { sum_a += h.surface.face + 1, ++count_a; });
    each_on_ray(brute, ray,
                [&](const TriangleOnRay& h) { sum_b += h.surface.face + 1, ++count_b; });
    ASSERT_EQ(count_a, count_b) << where;
    ASSERT_EQ(sum_a, sum_b) << where;
  }
};

// Places where ties and rounding matter: corners, middles of sides, points above them, the
// content's centre, and points at random near and far.
Vec3 query(Random& random, const TriangleMesh& mesh, double size) {
  const auto f = static_cast<Index>(random() % static_cast<std::uint64_t>(mesh.face_count()));
  const Vec3 corner = mesh.corner(f, 0);
  const Vec3 middle = 0.5 * (mesh.corner(f, 0) + mesh.corner(f, 1));
  switch (random() % 8) {
    case 0:
      return corner;
    case 1:
      return middle;
    case 2:
      return corner + uniform_vector(random, 0.01 * size);
    case 3:
      return middle + 0.1 * size * Vec3::Unit(static_cast<int>(random() % 3));
    case 4:
      return mimicry::bounding_box(mesh).center();
    case 5:
      return corner + uniform_vector(random, 100.0 * size);
    case 6:
      return corner + uniform_vector(random, 1e7 * size);
    default:
      return corner + uniform_vector(random, size);
  }
}

TEST(Bvh, ClosestPointEqualsBruteForce) {
  for (const Named& named : meshes())
    for (const double scale : {1.0, 1e-6, 1e6})
      for (const double offset : {0.0, 1e4}) {
        const Both both(test::transformed(named.mesh, scale, scale * offset * Vec3(1, -0.7, 0.3)));
        Random random(11);
        const std::string where = named.name + " scale " + std::to_string(scale);
        for (int i = 0; i < 150; ++i)
          ASSERT_NO_FATAL_FAILURE(
              both.expect_same(query(random, both.mesh, scale), kInfinity, kNone, where));
      }
}

TEST(Bvh, HintsAndBoundsNeverChangeTheAnswer) {
  for (const Named& named : meshes()) {
    const Both both(named.mesh);
    Random random(12);
    for (int i = 0; i < 300; ++i) {
      const Vec3 y = query(random, named.mesh, 1.0);
      const auto hint =
          static_cast<Index>(random() % static_cast<std::uint64_t>(named.mesh.face_count()));
      const double exact = nearest_triangle(both.brute, y, kInfinity, kNone, both.get()).distance2;
      ASSERT_NO_FATAL_FAILURE(both.expect_same(y, kInfinity, hint, named.name));
      // The bound itself is allowed; just below it there is nothing.
      ASSERT_NO_FATAL_FAILURE(both.expect_same(y, exact, hint, named.name));
      ASSERT_NO_FATAL_FAILURE(both.expect_same(y, exact, kNone, named.name));
      if (exact > 0.0) {
        const double below = std::nextafter(exact, 0.0);
        EXPECT_EQ(nearest_triangle(both.bvh, y, below, hint, both.get()).surface.face, kNone);
      }
    }
  }
}

TEST(Bvh, RaysEqualBruteForce) {
  for (const Named& named : meshes())
    for (const double scale : {1.0, 1e-6, 1e6})
      for (const double offset : {0.0, 1e4}) {
        const Both both(test::transformed(named.mesh, scale, scale * offset * Vec3(1, -0.7, 0.3)));
        Random random(13);
        const std::string where = named.name + " scale " + std::to_string(scale);
        for (int i = 0; i < 150; ++i) {
          const Vec3 origin = query(random, both.mesh, scale);
          const Vec3 to = query(random, both.mesh, scale);
          Vec3 direction = to - origin;
          if (i % 3 == 0 || direction.isZero(0.0)) direction = unit_vector(random);
          if (i % 3 == 1)
            direction =
                (random() % 2 == 0 ? 1.0 : -1.0) * Vec3::Unit(static_cast<int>(random() % 3));
          ASSERT_NO_FATAL_FAILURE(both.expect_same_ray(origin, direction.normalized(), where));
        }
      }
}

TEST(Bvh, RefitAnswersAsARebuildDoes) {
  const TriangleMesh mesh = make_torus(40, 20, 1.0, 0.4);
  Bvh<3, Triangle> refitted(mesh.face_count(), [&](Index f) { return test::triangle_of(mesh, f); });
  Random random(14);
  std::vector<Vec3> moved(mesh.positions().begin(), mesh.positions().end());
  for (Vec3& p : moved) p = 3.0 * p + Vec3(5, 6, 7) + uniform_vector(random, 0.2);
  const Both both(mesh.with_positions(moved));
  refitted.refit(both.get());
  for (int i = 0; i < 500; ++i) {
    const Vec3 y = query(random, both.mesh, 3.0);
    const NearestTriangle a = nearest_triangle(refitted, y, kInfinity, kNone, both.get());
    const NearestTriangle b = nearest_triangle(both.brute, y, kInfinity, kNone, both.get());
    ASSERT_EQ(a.surface.face, b.surface.face);
    ASSERT_EQ(a.surface.bary, b.surface.bary);
    const Ray ray(y, unit_vector(random));
    ASSERT_EQ(first_on_ray(refitted, ray).surface.face, first_on_ray(both.brute, ray).surface.face);
  }
}

TEST(Bvh, AnyLeafOrderAnswersAsBruteForceDoes) {
  for (const Named& named : meshes()) {
    const Both both(named.mesh);
    const auto count = static_cast<Index>(named.mesh.face_count());
    std::vector<Vec3> centres;
    for (Index f = 0; f < count; ++f) centres.push_back(both.get()(f).box().center());
    std::vector<Index> scattered(static_cast<std::size_t>(count));
    for (Index f = 0; f < count; ++f)
      scattered[static_cast<std::size_t>(f)] = static_cast<Index>(f * 7919LL % count);
    if (count % 7919 == 0) scattered.clear();
    const auto box = mimicry::bounding_box(named.mesh);
    for (const std::vector<Index>& order :
         {std::vector<Index>(), scattered, leaf_order<3>(centres)}) {
      const Bvh<3, Triangle> bvh(box, count, both.get(), order);
      Random random(16);
      for (int i = 0; i < 100; ++i) {
        const Vec3 y = query(random, named.mesh, 1.0);
        const NearestTriangle a = nearest_triangle(bvh, y, kInfinity, kNone, both.get());
        const NearestTriangle b = nearest_triangle(both.brute, y, kInfinity, kNone, both.get());
        ASSERT_EQ(a.surface.face, b.surface.face) << named.name;
        const Ray ray(y, unit_vector(random));
        ASSERT_EQ(first_on_ray(bvh, ray).surface.face, first_on_ray(both.brute, ray).surface.face)
            << named.name;
      }
    }
  }
}

TEST(LeafOrder, BlocksLieTogetherAndTheLastStayBehind) {
  Random random(17);
  for (const int count : {0, 1, 4, 5, 16, 17, 63, 200, 1025}) {
    std::vector<Vec3> points;
    for (int i = 0; i < count; ++i) points.push_back(uniform_vector(random, 1.0));
    const Index last = count / 3, own = count - last;
    const std::vector<Index> order = leaf_order<3>(points, last);
    std::vector<Index> sorted = order;
    std::sort(sorted.begin(), sorted.end());
    for (Index i = 0; i < count; ++i) ASSERT_EQ(sorted[static_cast<std::size_t>(i)], i);
    for (Index i = 0; i < count; ++i)
      ASSERT_EQ(order[static_cast<std::size_t>(i)] >= own, i >= own) << count;
  }
  // A row of 64 points: every block is a run of it.
  std::vector<Vec3> row;
  for (int i = 0; i < 64; ++i) row.push_back(Vec3(i * 37 % 64, 0.0, 0.0));
  const std::vector<Index> order = leaf_order<3>(row);
  for (std::size_t i = 0; i < 64; ++i)
    EXPECT_EQ(static_cast<std::size_t>(row[static_cast<std::size_t>(order[i])][0]) / 4, i / 4);
}

// Boxes alone, in eight dimensions, as the Phong projection and point location use them.
struct Block {
  Eigen::AlignedBox<double, 8> extent;
  Eigen::AlignedBox<double, 8> box() const { return extent; }
};

TEST(Bvh, EightDimensionsAndAnyVisitor) {
  using Point8 = Eigen::Matrix<double, 8, 1>;
  Random random(15);
  const auto point = [&](double size) {
    Point8 p;
    for (int k = 0; k < 8; ++k) p[k] = uniform(random, -size, size);
    return p;
  };
  std::vector<Block> blocks;
  for (int i = 0; i < 400; ++i) {
    Block b;
    const Point8 middle = point(1.0);
    for (int k = 0; k < 3; ++k) b.extent.extend(Point8(middle + point(0.4)));
    blocks.push_back(b);
  }
  const auto get = [&](Index i) { return blocks[static_cast<std::size_t>(i)]; };
  const Bvh<8, Block> bvh(400, get);
  const BruteForce<8, Block> brute(400, get);
  for (int i = 0; i < 200; ++i) {
    const Point8 y = point(i % 2 == 0 ? 0.3 : 2.0);
    // A visitor that accepts every third block only.
    const auto nearest = [&](const auto& hierarchy, int& visits) {
      std::pair<double, Index> best = {kInfinity, kNone};
      hierarchy.nearest(y, kInfinity, [&](Index n, const Block& b, double bound) {
        ++visits;
        const double d = (b.extent.center() - y).squaredNorm();
        if (n % 3 != 0 || d > bound) return bound;
        best = std::min(best, {d, n});
        return d;
      });
      return best;
    };
    int visits = 0, all = 0;
    ASSERT_EQ(nearest(bvh, visits), nearest(brute, all));
    ASSERT_LE(visits, all);

    std::vector<Index> inside, expected;
    bvh.containing(y, [&](Index n, const Block& b) {
      if (b.extent.contains(y)) inside.push_back(n);
      return false;
    });
    brute.containing(y, [&](Index n, const Block&) { return expected.push_back(n), false; });
    std::sort(inside.begin(), inside.end());
    ASSERT_EQ(inside, expected);
  }
}

TEST(Bvh, EmptyFindsNothing) {
  const Bvh<3, Triangle> bvh(0, [](Index) { return Triangle(); });
  const auto never = [](Index, const Triangle&, double bound) {
    ADD_FAILURE();
    return bound;
  };
  bvh.nearest(Vec3::Zero(), kInfinity, never);
  bvh.along(Vec3::Zero(), Vec3::UnitX(), kInfinity, never);
  EXPECT_FALSE(bvh.containing(Vec3::Zero(), [](Index, const Triangle&) { return true; }));
}

}  // namespace
}  // namespace mimicry
