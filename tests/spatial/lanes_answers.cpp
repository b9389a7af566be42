// Prints answers of the hierarchies and of the exact predicates, to the last bit. Built twice, with
// the compiler's extensions and without them: both print the same.
#include <array>
#include <bit>
#include <cinttypes>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <vector>

#include <mimicry/base/random.h>

#include "bake/delaunay.h"
#include "phong/triangle8.h"
#include "spatial/bvh.h"
#include "spatial/triangle.h"

namespace mimicry {
namespace {

void print(double x) {
  std::printf(" %016" PRIx64, std::bit_cast<std::uint64_t>(x));
}

template <class Vector>
Vector random_vector(Random& random) {
  Vector x;
  for (Eigen::Index k = 0; k < x.size(); ++k) x[k] = random.normal();
  return x;
}

// Triangles of sizes over six decades, some of them needles, some without area.
template <class Vector>
std::vector<std::array<Vector, 3>> random_triangles(Random& random, int count) {
  std::vector<std::array<Vector, 3>> triangles(static_cast<std::size_t>(count));
  for (auto& corners : triangles) {
    const Vector where = random_vector<Vector>(random);
    const double size = std::pow(2.0, random.uniform(-20.0, -1.0));
    for (Vector& corner : corners) corner = where + size * random_vector<Vector>(random);
    if (random.below(8) == 0) corners[2] = 0.5 * (corners[0] + corners[1]);
  }
  return triangles;
}

// Numbers of the primitives that a search visits, in its order, fold into one: what a sieve keeps
// is seen, too.
struct Visits {
  std::uint64_t all = 0;
  void add(Index i) { all = all * 1099511628211U + static_cast<std::uint64_t>(i) + 1; }
};

void print_surface(Random& random, double scale) {
  const auto triangles = random_triangles<Vec3>(random, 3000);
  const auto get = [&](Index i) {
    const auto& t = triangles[static_cast<std::size_t>(i)];
    return Triangle{scale * t[0], scale * t[1], scale * t[2]};
  };
  const Bvh<3, Triangle> bvh(static_cast<Index>(triangles.size()), get);
  for (int query = 0; query < 2000; ++query) {
    const Vec3 y = scale * std::pow(10.0, random.uniform(-2.0, 4.0)) * random_vector<Vec3>(random);
    Visits visits;
    TrianglePoint best{Vec3::Zero(), kInfinity};
    bvh.nearest(y, kInfinity, [&](Index i, const Triangle& t, double bound2) {
      visits.add(i);
      const TrianglePoint found = closest_point(t, y);
      if (found.distance2 < best.distance2) best = found;
      return std::min(bound2, found.distance2);
    });
    std::printf("%016" PRIx64, visits.all);
    print(best.distance2);
    for (const double b : best.bary) print(b);

    const Vec3 direction = (scale * random_vector<Vec3>(random) - y).normalized();
    const Ray ray(y, direction);
    visits = {};
    double first = kInfinity;
    bvh.along(y, direction, kInfinity, [&](Index i, const Triangle& t, double bound) {
      visits.add(i);
      if (const auto hit = ray.hit(t)) first = std::min(first, hit->t);
      return std::min(bound, first);
    });
    std::printf(" %016" PRIx64, visits.all);
    print(first);
    std::printf("\n");
  }
}

void print_embedded(Random& random) {
  const auto triangles = random_triangles<Vec8>(random, 2000);
  const auto get = [&](Index i) {
    const auto& t = triangles[static_cast<std::size_t>(i)];
    return Triangle8{{&t[0], &t[1], &t[2]}};
  };
  const Bvh<8, Triangle8> bvh(static_cast<Index>(triangles.size()), get);
  for (int query = 0; query < 500; ++query) {
    const Vec8 y = random.uniform(0.1, 3.0) * random_vector<Vec8>(random);
    Visits visits;
    double nearest2 = kInfinity;
    bvh.nearest(y, kInfinity, [&](Index i, const auto&, double bound2) {
      visits.add(i);
      for (const Vec8& corner : triangles[static_cast<std::size_t>(i)])
        nearest2 = std::min(nearest2, (corner - y).squaredNorm());
      return std::min(bound2, nearest2);
    });
    std::printf("%016" PRIx64, visits.all);
    print(nearest2);
    std::printf("\n");
  }
}

// Among so few coordinates, and on so small a sphere, many signs are 0 and most need the integers.
void print_signs(Random& random) {
  for (const std::uint64_t top : {4, 1 << 12, 1 << kGridBits})
    for (int trial = 0; trial < 3000; ++trial) {
      std::array<GridPoint, 5> p;
      for (auto& point : p)
        for (auto& coordinate : point) coordinate = static_cast<std::int32_t>(random.below(top));
      if (trial % 2 == 0) p[4] = {p[0][0], p[1][1], p[2][2]};
      std::printf("%d %d\n", orientation(p[0], p[1], p[2], p[3]),
                  in_sphere(p[0], p[1], p[2], p[3], p[4]));
    }
}

// All that a filter in floating point leaves to the integers: points of one great sphere.
void print_close_signs(Random& random) {
  constexpr std::int32_t kMiddle = 1 << 23, kRadius = (1 << 23) - 1;
  const std::array<GridPoint, 6> sphere = {{{kMiddle + kRadius, kMiddle, kMiddle},
                                            {kMiddle - kRadius, kMiddle, kMiddle},
                                            {kMiddle, kMiddle + kRadius, kMiddle},
                                            {kMiddle, kMiddle - kRadius, kMiddle},
                                            {kMiddle, kMiddle, kMiddle + kRadius},
                                            {kMiddle, kMiddle, kMiddle - kRadius}}};
  for (int trial = 0; trial < 2000; ++trial) {
    std::array<GridPoint, 5> p;
    for (auto& point : p) {
      point = sphere[random.below(sphere.size())];
      if (random.below(2) == 0)
        point[random.below(3)] ^= static_cast<std::int32_t>(random.below(4));
    }
    std::printf("%d %d\n", orientation(p[0], p[1], p[2], p[3]),
                in_sphere(p[0], p[1], p[2], p[3], p[4]));
  }
}

}  // namespace
}  // namespace mimicry

int main() {
  mimicry::Random random(11);
  for (const double scale : {1.0, 1e-20, 1e20}) mimicry::print_surface(random, scale);
  mimicry::print_embedded(random);
  mimicry::print_signs(random);
  mimicry::print_close_signs(random);
}
