#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include <mimicry/mesh/shapes.h>

#include "spatial/bvh.h"
#include "spatial/meshes.h"
#include "spatial/surface_search.h"

namespace mimicry {
namespace {

using test::Random;

#if defined(NDEBUG) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
constexpr int kRays = 1'000'000;
#else
constexpr int kRays = 40'000;
#endif

// Rays from inside a closed mesh at its vertices and at points of its edges.
int escapes(const TriangleMesh& mesh, const Vec3& inside, double spread, std::uint64_t seed) {
  const Bvh<3, Triangle> bvh(mesh.face_count(),
                             [&](Index f) { return test::triangle_of(mesh, f); });
  Random random(seed);
  int escaped = 0;
  for (int i = 0; i < kRays; ++i) {
    const auto f = static_cast<Index>(random() % static_cast<std::uint64_t>(mesh.face_count()));
    const int k = static_cast<int>(random() % 3);
    const double t = random() % 3 == 0 ? 0.0 : test::uniform(random, 0.0, 1.0);
    const Vec3 aim = mesh.corner(f, k) + t * (mesh.corner(f, (k + 1) % 3) - mesh.corner(f, k));
    const Vec3 origin = i % 4 == 0 ? inside : Vec3(inside + test::uniform_vector(random, spread));
    const Vec3 direction = (aim - origin).normalized();
    if (first_on_ray(bvh, Ray(origin, direction)).surface.face == kNone) ++escaped;
  }
  return escaped;
}

TEST(Watertight, NoRayEscapesThroughEdgesAndVerticesOfATorus) {
  const TriangleMesh mesh = make_torus(40, 20, 1.0, 0.4);
  EXPECT_EQ(escapes(mesh, Vec3(1.0, 0.0, 0.0), 0.1, 21), 0);
}

TEST(Watertight, NoRayEscapesFromACubeWithGridLinesInLineWithTheOrigin) {
  EXPECT_EQ(escapes(make_box(6, 6, 6, Vec3::Ones()), Vec3::Zero(), 0.9, 22), 0);
}

TEST(Watertight, NoRayEscapesFromATinyOrShiftedMesh) {
  const Vec3 offset(1e4, -7e3, 3e3);
  EXPECT_EQ(escapes(test::transformed(make_torus(30, 12, 1.0, 0.4), 1.0, offset),
                    Vec3(1.0, 0.0, 0.0) + offset, 0.1, 23),
            0);
  EXPECT_EQ(escapes(test::transformed(make_torus(30, 12, 1.0, 0.4), 1e-6, Vec3::Zero()),
                    Vec3(1e-6, 0.0, 0.0), 1e-7, 24),
            0);
}

TEST(Watertight, NoRayEscapesThroughNeedlesAndFlatFaces) {
  // A double cone whose belt is of needles: half of its faces are a millionth as high as wide, some
  // have no height at all.
  Random random(25);
  std::vector<Vec3> p = {Vec3(0, 0, 1), Vec3(0, 0, -1)};
  std::vector<Face> faces;
  constexpr Index kSides = 60;
  for (Index i = 0; i < kSides; ++i) {
    const double a = 2.0 * std::numbers::pi * i / kSides;
    const double gap = i % 3 == 0 ? 0.0 : 1e-7 * test::uniform(random, 0.5, 1.0);
    p.emplace_back(std::cos(a), std::sin(a), gap);
    p.emplace_back(std::cos(a), std::sin(a), -gap);
  }
  for (Index i = 0; i < kSides; ++i) {
    const Index t0 = 2 + 2 * i, b0 = t0 + 1, t1 = 2 + 2 * ((i + 1) % kSides), b1 = t1 + 1;
    faces.insert(faces.end(), {{0, t0, t1}, {1, b1, b0}, {t0, b0, b1}, {t0, b1, t1}});
  }
  EXPECT_EQ(escapes({p, faces}, Vec3::Zero(), 0.2, 26), 0);
}

}  // namespace
}  // namespace mimicry
