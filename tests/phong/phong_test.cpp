#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <mimicry/base/error.h>
#include <mimicry/base/random.h>
#include <mimicry/mesh/half_edges.h>
#include <mimicry/mesh/shapes.h>

#include "phong/phong_surface.h"
#include "support/allocations.h"

namespace mimicry {
namespace {

// Stands in for an embedding: the mesh's own three dimensions and five that bend with them, so that
// all eight matter.
std::vector<double> bent_values(const TriangleMesh& mesh, double bend) {
  std::vector<double> values;
  for (const Vec3& p : mesh.positions()) {
    values.insert(values.end(), {p[0], p[1], p[2]});
    for (int k = 0; k < 5; ++k)
      values.push_back(bend * std::sin((1.0 + 0.3 * k) * (p[k % 3] + 0.5 * p[(k + 1) % 3])));
  }
  return values;
}

struct Surface {
  TriangleMesh mesh;
  HalfEdges edges;
  std::vector<double> values;
  PhongSurface phong;

  explicit Surface(TriangleMesh m, double bend = 0.3)
      : mesh(std::move(m)),
        edges(mesh),
        values(bent_values(mesh, bend)),
        phong(mesh, edges, values, kDimension) {}

  SurfacePoint random_point(Random& random) const {
    SurfacePoint p;
    p.face = static_cast<Index>(random.below(static_cast<std::uint32_t>(mesh.face_count())));
    const double r = std::sqrt(random.uniform()), s = random.uniform();
    p.bary = Vec3(1.0 - r, r * (1.0 - s), r * s);
    return p;
  }
  Vec8 near_surface(Random& random, double distance) const {
    Vec8 y = phong.position(random_point(random));
    for (int k = 0; k < kDimension; ++k) y[k] += distance * random.normal();
    return y;
  }
};

std::vector<TriangleMesh> meshes() {
  std::vector<TriangleMesh> result;
  result.push_back(make_sphere(8));
  result.push_back(make_torus(24, 12));
  result.push_back(make_box(5, 4, 3, Vec3(1, 0.7, 0.4)));
  result.push_back(make_grid(9));  // boundary
  result.push_back(make_noisy_cube(6, 0.2, true, 3));
  result.push_back(make_moebius_strip(24));
  result.push_back(make_two_spheres(4));
  return result;
}

TEST(NearestOrthogonal, IsThePolarFactor) {
  Random random(1);
  for (int i = 0; i < 200; ++i) {
    Mat2 m;
    for (int k = 0; k < 4; ++k) m.data()[k] = random.normal();
    const Mat2 q = nearest_orthogonal(m);
    EXPECT_LT((q * q.transpose() - Mat2::Identity()).norm(), 1e-14);
    // The other factor is symmetric and has no negative eigenvalue.
    const Mat2 p = q.transpose() * m;
    EXPECT_NEAR(p(0, 1), p(1, 0), 1e-14);
    EXPECT_GE(p.trace(), 0.0);
    EXPECT_GE(p.determinant(), -1e-14);
  }
  EXPECT_EQ(nearest_orthogonal(Mat2::Zero()), Mat2::Identity());
}

TEST(TangentBases, AreOrthonormalAndTangentToASphere) {
  const TriangleMesh mesh = make_sphere(8);
  std::vector<Vec8> values;
  for (const Vec3& p : mesh.positions()) {
    values.push_back(Vec8::Zero());
    values.back().head<3>() = p;
  }
  const auto bases = tangent_bases(HalfEdges(mesh), mesh.faces(), values);
  for (std::size_t v = 0; v < values.size(); ++v) {
    EXPECT_LT((bases[v] * bases[v].transpose() - Mat2::Identity()).norm(), 1e-13);
    // The rings are not regular: the mesh's edges subtend 8 degrees.
    EXPECT_LT((bases[v] * values[v]).norm(), 0.02);
  }
}

TEST(TangentBases, LieInAFlatSheetToItsBoundary) {
  const TriangleMesh mesh = make_grid(7);
  std::vector<Vec8> values;
  for (const Vec3& p : mesh.positions()) {
    values.push_back(Vec8::Zero());
    values.back().segment<3>(3) = p;
  }
  for (const Basis& basis : tangent_bases(HalfEdges(mesh), mesh.faces(), values)) {
    EXPECT_LT((basis * basis.transpose() - Mat2::Identity()).norm(), 1e-13);
    EXPECT_NEAR(basis.middleCols<2>(3).determinant() * basis.middleCols<2>(3).determinant(), 1.0,
                1e-12);
  }
}

TEST(TangentBases, ATipOfTwoConesHasOne) {
  // Two tetrahedra's tips that touch in vertex 0, and vertex 9 in no face.
  std::vector<Vec8> values(10, Vec8::Zero());
  Random random(3);
  for (Vec8& x : values)
    for (int k = 0; k < kDimension; ++k) x[k] = random.normal();
  const std::vector<Face> faces = {{0, 1, 2}, {0, 2, 3}, {0, 3, 1},
                                   {0, 4, 5}, {0, 5, 6}, {0, 6, 4}};
  const TriangleMesh mesh(std::vector<Vec3>(10, Vec3::Zero()), faces);
  for (const Basis& basis : tangent_bases(HalfEdges(mesh), faces, values))
    EXPECT_LT((basis * basis.transpose() - Mat2::Identity()).norm(), 1e-13);
}

TEST(PhongSurface, EquationIsTheTangentPlaneTimesTheDifference) {
  Random random(5);
  for (const TriangleMesh& mesh : meshes()) {
    const Surface s(mesh);
    for (int i = 0; i < 50; ++i) {
      const SurfacePoint p = s.random_point(random);
      const Vec8 y = s.near_surface(random, 0.2);
      const Vec2 expected = s.phong.tangent_plane(p) * (y - s.phong.position(p));
      EXPECT_LT((s.phong.equation(p.face, y).evaluate(p.bary).f - expected).norm(), 1e-13);
    }
  }
}

TEST(PhongSurface, JacobianEqualsFiniteDifferences) {
  Random random(6);
  for (const TriangleMesh& mesh : meshes()) {
    const Surface s(mesh);
    for (int i = 0; i < 50; ++i) {
      SurfacePoint p = s.random_point(random);
      p.bary = 0.9 * p.bary + Vec3::Constant(0.1 / 3.0);  // steps stay away from the corners
      const FaceEquation equation = s.phong.equation(p.face, s.near_surface(random, 0.2));
      const auto value = equation.evaluate(p.bary);
      constexpr double kStep = 1e-6;
      for (int c = 0; c < 2; ++c) {
        const Vec3 step = kStep * (Vec3::Unit(c + 1) - Vec3::Unit(0));
        const Vec2 slope =
            (equation.evaluate(p.bary + step).f - equation.evaluate(p.bary - step).f) /
            (2.0 * kStep);
        // Rounding of 1e-16 over the step, and the third derivative times its square.
        EXPECT_LT((slope - value.jacobian.col(c)).norm(), 1e-8);
      }
    }
  }
}

TEST(PhongSurface, TangentPlaneIsContinuousAcrossEdges) {
  Random random(7);
  for (const TriangleMesh& mesh : meshes()) {
    const Surface s(mesh);
    for (Index h = 0; h < s.edges.count(); ++h) {
      if (!s.edges.has_twin(h)) continue;
      const double t = random.uniform(0.01, 0.99);
      SurfacePoint a{HalfEdges::face(h), Vec3::Zero()},
          b{HalfEdges::face(s.edges.twin(h)), Vec3::Zero()};
      a.bary[HalfEdges::corner(h)] = 1.0 - t;
      a.bary[HalfEdges::corner(HalfEdges::next(h))] = t;
      b.bary[HalfEdges::corner(s.edges.twin(h))] = t;
      b.bary[HalfEdges::corner(HalfEdges::next(s.edges.twin(h)))] = 1.0 - t;
      // The same rows up to an orthogonal matrix: the same Gram matrix in R^8.
      const Basis ta = s.phong.tangent_plane(a), tb = s.phong.tangent_plane(b);
      EXPECT_LT((ta.transpose() * ta - tb.transpose() * tb).norm(), 1e-12);
    }
  }
}

TEST(PhongSurface, PointsOfTheSurfaceProjectToThemselves) {
  Random random(8);
  for (const TriangleMesh& mesh : meshes()) {
    const Surface s(mesh);
    for (int i = 0; i < 300; ++i) {
      SurfacePoint p = s.random_point(random);
      if (i % 3 == 1) p.bary = Vec3::Unit(i % 9 / 3);  // a corner
      if (i % 3 == 2) {                                // on an edge
        p.bary[i % 9 / 3] = 0.0;
        p.bary /= p.bary.sum();
      }
      const Vec8 y = s.phong.position(p);
      const auto q = s.phong.project(y);
      ASSERT_TRUE(q);
      EXPECT_LT((s.mesh.position(q->surface) - s.mesh.position(p)).norm(), 1e-9 * s.phong.size());
    }
  }
}

TEST(PhongSurface, SolutionsSolveTheEquation) {
  Random random(9);
  for (const TriangleMesh& mesh : meshes()) {
    const Surface s(mesh);
    int found = 0;
    for (int i = 0; i < 200; ++i) {
      const Vec8 y = s.near_surface(random, 0.05);
      const auto q = s.phong.project(y);
      if (!q) continue;
      ++found;
      EXPECT_GE(q->surface.bary.minCoeff(), 0.0);
      EXPECT_NEAR(q->surface.bary.sum(), 1.0, 1e-15);
      if (q->surface.bary.maxCoeff() > 1.0 - 1e-9) continue;
      const Vec2 f = s.phong.tangent_plane(q->surface) * (y - s.phong.position(q->surface));
      EXPECT_LT(f.norm(), 1e-8 * s.phong.size());
      EXPECT_NEAR(q->distance, (y - s.phong.position(q->surface)).norm(), 1e-14);
    }
    EXPECT_GT(found, 120);
  }
}

TEST(PhongSurface, FastSearchEqualsExhaustiveWhateverTheHint) {
  Random random(10);
  for (const TriangleMesh& mesh : meshes()) {
    const Surface s(mesh);
    for (int i = 0; i < 120; ++i) {
      const double distance = std::array{0.003, 0.05, 0.3, 1.0, 50.0}[i % 5];
      const Vec8 y = s.near_surface(random, distance);
      const auto truth = s.phong.project_exhaustively(y);
      const Index hint = s.random_point(random).face;
      for (const Index start : {kNone, hint, truth ? truth->surface.face : 0}) {
        const auto fast = s.phong.project(y, start);
        ASSERT_EQ(fast.has_value(), truth.has_value());
        if (!truth) continue;
        EXPECT_EQ(fast->surface.face, truth->surface.face);
        EXPECT_EQ(fast->surface.bary, truth->surface.bary);
        EXPECT_EQ(fast->distance, truth->distance);
      }
    }
  }
}

TEST(FaceEquation, NoSolutionIsLost) {
  Random random(11);
  int solutions = 0;
  for (const TriangleMesh& mesh : meshes()) {
    const Surface s(mesh, 0.6);
    for (int i = 0; i < 60; ++i) {
      // y over a point of the face, along the normal space, so that a solution exists.
      const SurfacePoint p = s.random_point(random);
      const Basis t = s.phong.tangent_plane(p);
      Vec8 away;
      for (int k = 0; k < kDimension; ++k) away[k] = random.normal();
      const Mat2 gram = t * t.transpose();
      if (!(gram.determinant() > 1e-3)) continue;
      away -= t.transpose() * gram.inverse() * (t * away);
      const Vec8 y = s.phong.position(p) + random.uniform(0.0, 0.5) * away;
      ++solutions;
      const auto found = s.phong.equation(p.face, y).solve(s.phong.size());
      double nearest = kInfinity;
      for (std::size_t n = 0; n < found.count; ++n)
        nearest = std::min(nearest, (found.b[n] - p.bary).norm());
      // Newton's last step is below 1e-12, times the conditioning of the triangle.
      EXPECT_LT(nearest, 1e-8) << "face " << p.face << " at " << p.bary.transpose();
    }
  }
  EXPECT_GT(solutions, 300);
}

TEST(FaceEquation, NoSolutionIsLostBesideACorner) {
  // Points are made of their solution: beside a corner, which Newton's method reaches from afar and
  // passes, and off the surface across the tangent plane there. Where that bends much over the face
  // a step beyond the corner is nearly as long as the way to it.
  Random random(16);
  for (const TriangleMesh& mesh : meshes()) {
    const Surface s(mesh);
    for (int i = 0; i < 1000; ++i) {
      SurfacePoint p = s.random_point(random);
      const double away = std::pow(10.0, random.uniform(-8.0, -1.0));
      p.bary = (1.0 - away) * Vec3::Unit(i % 3) + away * p.bary;
      const Basis t = s.phong.tangent_plane(p);
      Vec8 normal;
      for (int k = 0; k < kDimension; ++k) normal[k] = random.normal();
      normal -= t.transpose() * (t * t.transpose()).inverse() * (t * normal);
      const Vec8 y = s.phong.position(p) + 0.02 * random.uniform() * normal.normalized();
      const auto found = s.phong.equation(p.face, y).solve(s.phong.size());
      double nearest = kInfinity;
      for (std::size_t k = 0; k < found.count; ++k)
        nearest = std::min(nearest, (found.b[k] - p.bary).norm());
      // Where the tangent field bends much there are pairs of solutions; one of two that are nearer
      // to each other than this may hide the other.
      EXPECT_LT(nearest, 0.01) << "trial " << i << ", " << away << " from the corner";
    }
  }
}

TEST(PhongSurface, ProjectionIsTheFootOnAPlane) {
  const TriangleMesh mesh = make_grid(6);
  const Surface s(mesh, 0.0);
  Random random(12);
  for (int i = 0; i < 100; ++i) {
    Vec8 y = s.phong.position(s.random_point(random));
    Vec8 up = y;
    for (int k = 2; k < kDimension; ++k) up[k] += random.normal();
    const auto q = s.phong.project(up);
    ASSERT_TRUE(q);
    EXPECT_LT((s.phong.position(q->surface) - y).norm(), 1e-12);
  }
  Vec8 beside = Vec8::Zero();
  beside[0] = 1.5;
  EXPECT_FALSE(s.phong.project(beside)) << "beyond the boundary nothing is perpendicular";
}

TEST(PhongSurface, FarAndScaledAndDegenerate) {
  const Surface s(make_torus(24, 12));
  Random random(13);
  for (const double far : {1e3, 1e9, 1e30}) {
    const Vec8 y = far * s.near_surface(random, 1.0);
    const auto a = s.phong.project(y), b = s.phong.project_exhaustively(y);
    EXPECT_EQ(a.has_value(), b.has_value());
    if (a && b) {
      EXPECT_EQ(a->surface.face, b->surface.face);
    }
  }
  // A power of two changes no bit of the answer but the distance.
  std::vector<double> small = s.values;
  for (double& x : small) x *= 0x1p-40;
  const PhongSurface scaled(s.mesh, s.edges, small, kDimension);
  for (int i = 0; i < 50; ++i) {
    const Vec8 y = s.near_surface(random, 0.05);
    const auto a = s.phong.project(y), b = scaled.project(0x1p-40 * y);
    ASSERT_EQ(a.has_value(), b.has_value());
    if (a) {
      EXPECT_EQ(a->surface.bary, b->surface.bary);
    }
  }
  // Every vertex in one place.
  const std::vector<double> zeros(s.values.size(), 0.0);
  const PhongSurface point(s.mesh, s.edges, zeros, kDimension);
  point.project(Vec8::Ones());
  EXPECT_THROW(PhongSurface(s.mesh, s.edges, s.values, 9), Error);
}

TEST(PhongSurface, FewerDimensionsArePadded) {
  const TriangleMesh mesh = make_sphere(6);
  std::vector<double> values;
  for (const Vec3& p : mesh.positions()) values.insert(values.end(), {p[0], p[1], p[2]});
  const PhongSurface phong(mesh, HalfEdges(mesh), values, 3);
  Vec8 y = Vec8::Zero();
  y.head<3>() = Vec3(1, 2, 2) * 0.4;
  const auto q = phong.project(y);
  ASSERT_TRUE(q);
  // The facets leave the sphere by 1e-2.
  EXPECT_LT((mesh.position(q->surface) - Vec3(1, 2, 2) / 3.0).norm(), 0.02);
}

TEST(PhongSurface, QueriesAllocateNothing) {
  const Surface s(make_sphere(8));
  Random random(14);
  std::vector<Vec8> queries;
  for (int i = 0; i < 50; ++i) queries.push_back(s.near_surface(random, 0.1));
  const long before = test::allocation_count();
  int found = 0;
  for (const Vec8& y : queries) found += s.phong.project(y).has_value();
  EXPECT_EQ(test::allocation_count(), before);
  EXPECT_EQ(found, 50);
}

}  // namespace
}  // namespace mimicry
