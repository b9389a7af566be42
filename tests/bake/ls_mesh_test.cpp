#include "bake/ls_mesh.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include <mimicry/mesh/shapes.h>

namespace mimicry {
namespace {

struct Cloud {
  std::vector<Vec3> positions;
  std::vector<Tet> tets;
};

// Random points of the unit cube and their Delaunay tetrahedra.
Cloud random_cloud(int count, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_int_distribution<std::int32_t> coordinate(0, (1 << kGridBits) - 1);
  std::vector<GridPoint> grid(static_cast<std::size_t>(count));
  Cloud cloud;
  for (GridPoint& p : grid) {
    p = {coordinate(random), coordinate(random), coordinate(random)};
    cloud.positions.push_back(Vec3(p[0], p[1], p[2]) * 0x1p-24);
  }
  Delaunay d;
  d.insert(grid);
  cloud.tets = d.tets();
  return cloud;
}

Eigen::RowVectorXd linear(const Vec3& p, Eigen::Index dimension) {
  Eigen::RowVectorXd value(dimension);
  for (Eigen::Index k = 0; k < dimension; ++k)
    value[k] = 0.3 + (static_cast<double>(k) - 2.0) * p.x() + 0.5 * p.y() - p.z();
  return value;
}

std::vector<Index> every(Index step, std::size_t count) {
  std::vector<Index> out;
  for (Index v = 0; v < static_cast<Index>(count); v += step) out.push_back(v);
  return out;
}

TEST(LsMesh, FlatnessByDefinition) {
  const Vec3 a(0, 0, 0), b(1, 0, 0), c(0, 1, 0);
  EXPECT_FALSE(is_flat(a, b, c, {0, 0, 1}));
  EXPECT_TRUE(is_flat(a, b, c, {0, 0, -1}));
  // Longest edge sqrt 2: the limit is at the height 6e-2 * 2 sqrt 2.
  EXPECT_FALSE(is_flat(a, b, c, {0.3, 0.3, 1.01 * 6e-2 * std::pow(2.0, 1.5)}));
  EXPECT_TRUE(is_flat(a, b, c, {0.3, 0.3, 0.99 * 6e-2 * std::pow(2.0, 1.5)}));
}

TEST(LsMesh, LinearFunctionsInsideAFixedBoundaryLayer) {
  // L x vanishes at inner vertices for linear x, flat tetrahedra around them or not, and it is the
  // only x with all of its energy there: with the outer layers fixed the inside must be linear.
  const Cloud cloud = random_cloud(3000, 2);
  const Vec3 middle = Vec3::Constant(std::ldexp(1.0, kGridBits - 25));
  std::vector<Index> fixed;
  std::vector<bool> is_fixed(cloud.positions.size(), false);
  for (std::size_t v = 0; v < cloud.positions.size(); ++v)
    if ((cloud.positions[v] - middle).cwiseAbs().maxCoeff() > 0.5 * middle[0]) {
      fixed.push_back(static_cast<Index>(v));
      is_fixed[v] = true;
    }
  int flat_inside = 0;
  for (const Tet& t : cloud.tets) {
    const auto at = [&](std::size_t k) { return static_cast<std::size_t>(t[k]); };
    const bool is_inside = !is_fixed[at(0)] && !is_fixed[at(1)] && !is_fixed[at(2)];
    flat_inside += is_inside && is_flat(cloud.positions[at(0)], cloud.positions[at(1)],
                                        cloud.positions[at(2)], cloud.positions[at(3)]);
  }
  ASSERT_GT(flat_inside, 20);
  ASSERT_LT(fixed.size(), cloud.positions.size() - 80);
  Values values(static_cast<Eigen::Index>(fixed.size()), 8);
  for (std::size_t k = 0; k < fixed.size(); ++k)
    values.row(static_cast<Eigen::Index>(k)) =
        linear(cloud.positions[static_cast<std::size_t>(fixed[k])], 8);
  Executor executor;
  const LsMeshResult result = ls_mesh(
      {.positions = cloud.positions, .tets = cloud.tets, .fixed = fixed, .fixed_values = &values},
      {.tolerance = 1e-12, .most_iterations = 2000}, executor);
  EXPECT_TRUE(result.converged);
  double worst = 0.0;
  for (std::size_t v = 0; v < cloud.positions.size(); ++v)
    worst = std::max(
        worst, (result.values.row(static_cast<Eigen::Index>(v)) - linear(cloud.positions[v], 8))
                   .cwiseAbs()
                   .maxCoeff());
  // The solver leaves up to 3e-3 among tetrahedra this bad, more or less by how sums are rounded;
  // with nothing borrowed it is 4e-2.
  EXPECT_LT(worst, 1e-2);
}

struct Element {
  Eigen::Matrix4d hats;  // column k: hat function of corner k
  double volume;
  bool flat;

  Element(const Cloud& cloud, const Tet& t) {
    std::array<Vec3, 4> p;
    for (std::size_t k = 0; k < 4; ++k) p[k] = cloud.positions[static_cast<std::size_t>(t[k])];
    Eigen::Matrix4d m;
    for (int k = 0; k < 4; ++k) m.row(k) << 1.0, p[static_cast<std::size_t>(k)].transpose();
    hats = m.inverse();
    volume = std::abs(m.determinant()) / 6.0;
    flat = is_flat(p[0], p[1], p[2], p[3]);
  }
  // 3 by dimension
  Eigen::MatrixXd gradient(const Tet& t, const Values& x) const {
    Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(3, x.cols());
    for (int k = 0; k < 4; ++k)
      sum += hats.col(k).tail<3>() * x.row(t[static_cast<std::size_t>(k)]);
    return sum;
  }
};

bool share_a_face(const Tet& s, const Tet& t) {
  return std::count_if(s.begin(), s.end(),
                       [&](Index v) { return std::find(t.begin(), t.end(), v) != t.end(); }) == 3;
}

// The energy by its definition, dense.
double energy(const Cloud& cloud, const Values& x) {
  Values image = Values::Zero(x.rows(), x.cols());
  Eigen::VectorXd mass = Eigen::VectorXd::Zero(x.rows());
  for (const Tet& t : cloud.tets) {
    const Element e(cloud, t);
    Eigen::MatrixXd gradient = e.gradient(t, x);
    if (e.flat) {
      gradient.setZero();
      int lenders = 0;
      for (const Tet& other : cloud.tets) {
        if (!share_a_face(other, t)) continue;
        const Element lender(cloud, other);
        if (lender.flat) continue;
        gradient += lender.gradient(other, x);
        ++lenders;
      }
      gradient /= std::max(lenders, 1);
    }
    for (int i = 0; i < 4; ++i) {
      const Index v = t[static_cast<std::size_t>(i)];
      if (!e.flat) mass[v] += e.volume / 4.0;
      image.row(v) += e.volume * e.hats.col(i).tail<3>().transpose() * gradient;
    }
  }
  double sum = 0.0;
  for (Eigen::Index i = 0; i < x.rows(); ++i)
    if (mass[i] > 0.0) sum += image.row(i).squaredNorm() / mass[i];
  return sum;
}

TEST(LsMesh, MinimisesTheEnergyAndKeepsTheSamples) {
  const Cloud cloud = random_cloud(400, 5);
  const std::vector<Index> fixed = every(7, cloud.positions.size());
  Values values(static_cast<Eigen::Index>(fixed.size()), 3);
  for (Eigen::Index k = 0; k < values.rows(); ++k) {
    const Vec3& p = cloud.positions[static_cast<std::size_t>(fixed[static_cast<std::size_t>(k)])];
    values.row(k) << std::sin(5 * p.x()), p.y() * p.z(), p.x() + p.y();
  }
  Executor executor;
  const LsMeshResult result = ls_mesh(
      {.positions = cloud.positions, .tets = cloud.tets, .fixed = fixed, .fixed_values = &values},
      {.tolerance = 1e-10, .most_iterations = 2000}, executor);
  ASSERT_TRUE(result.converged);
  for (std::size_t k = 0; k < fixed.size(); ++k)
    EXPECT_TRUE(result.values.row(fixed[k]) == values.row(static_cast<Eigen::Index>(k)));
  // Along any direction that keeps the samples the energy is a parabola with its bottom here.
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  Values direction(result.values.rows(), 3);
  for (Eigen::Index k = 0; k < direction.size(); ++k) direction.data()[k] = normal(random);
  for (const Index v : fixed) direction.row(v).setZero();
  const double here = energy(cloud, result.values);
  const double ahead = energy(cloud, result.values + 1e-3 * direction);
  const double behind = energy(cloud, result.values - 1e-3 * direction);
  EXPECT_GT(ahead, here);
  EXPECT_GT(behind, here);
  EXPECT_NEAR((ahead - behind) / (ahead + behind - 2.0 * here), 0.0, 1e-4);
}

TEST(LsMesh, TiedVerticesAreEliminated) {
  const Cloud cloud = random_cloud(300, 6);
  const std::vector<Index> fixed = every(11, cloud.positions.size());
  Values values(static_cast<Eigen::Index>(fixed.size()), 8);
  for (Eigen::Index k = 0; k < values.rows(); ++k)
    values.row(k) =
        linear(cloud.positions[static_cast<std::size_t>(fixed[static_cast<std::size_t>(k)])], 8)
            .array()
            .sin();
  const std::vector<Tie> ties = {
      {.vertex = 5, .corners = {0, 8, kNone}, .weights = {0.25, 0.75, 0}},
      {.vertex = 9, .corners = {1, 2, 11}, .weights = {0.2, 0.3, 0.5}}};
  Executor executor;
  const LsMeshResult result = ls_mesh({.positions = cloud.positions,
                                       .tets = cloud.tets,
                                       .ties = ties,
                                       .fixed = fixed,
                                       .fixed_values = &values},
                                      {.tolerance = 1e-9, .most_iterations = 2000}, executor);
  ASSERT_TRUE(result.converged);
  const Values& x = result.values;
  EXPECT_LT((x.row(5) - 0.25 * x.row(0) - 0.75 * x.row(8)).norm(), 1e-14);
  EXPECT_LT((x.row(9) - 0.2 * x.row(1) - 0.3 * x.row(2) - 0.5 * x.row(11)).norm(), 1e-14);
  // Still a minimum along a direction that respects the ties.
  Values direction = Values::Zero(x.rows(), x.cols());
  direction.row(8).setOnes();
  direction.row(2).setConstant(-0.5);
  direction.row(5) = 0.75 * direction.row(8);
  direction.row(9) = 0.3 * direction.row(2);
  const double here = energy(cloud, x);
  const double ahead = energy(cloud, x + 1e-2 * direction);
  const double behind = energy(cloud, x - 1e-2 * direction);
  EXPECT_NEAR((ahead - behind) / (ahead + behind - 2.0 * here), 0.0, 1e-3);
}

TEST(LsMesh, SoftConstraintsPullWhereTheyAreStrong) {
  const Cloud cloud = random_cloud(300, 8);
  Values wished(2, 8);
  wished.row(0).setConstant(1.0);
  wished.row(1).setConstant(-2.0);
  std::vector<SoftConstraint> soft(2);
  soft[0] = {
      .vertices = {3, 4, kNone, kNone}, .weights = {0.5, 0.5, 0.0, 0.0}, .strength = 1e3, .row = 0};
  soft[1] = {.vertices = {100, kNone, kNone, kNone},
             .weights = {1.0, 0.0, 0.0, 0.0},
             .strength = 1e3,
             .row = 1};
  Executor executor;
  const LsMeshResult result = ls_mesh(
      {.positions = cloud.positions, .tets = cloud.tets, .soft = soft, .soft_values = &wished},
      {.tolerance = 1e-9, .most_iterations = 3000}, executor);
  EXPECT_NEAR(0.5 * (result.values(3, 0) + result.values(4, 0)), 1.0, 1e-3);
  EXPECT_NEAR(result.values(100, 7), -2.0, 1e-3);
}

TEST(LsMesh, SurfacesWorkToo) {
  // Planar and linear on the outer two rings: linear inside.
  const TriangleMesh mesh = make_grid(12);
  std::vector<Index> fixed;
  for (Index v = 0; v < mesh.vertex_count(); ++v)
    if (mesh.position(v).cwiseAbs().maxCoeff() > 0.7) fixed.push_back(v);
  Values values(static_cast<Eigen::Index>(fixed.size()), 8);
  for (std::size_t k = 0; k < fixed.size(); ++k)
    values.row(static_cast<Eigen::Index>(k)) = linear(mesh.position(fixed[k]), 8);
  Executor executor;
  const LsMeshResult result = ls_mesh({.positions = mesh.positions(),
                                       .faces = mesh.faces(),
                                       .fixed = fixed,
                                       .fixed_values = &values},
                                      {.tolerance = 1e-10}, executor);
  for (Index v = 0; v < mesh.vertex_count(); ++v)
    EXPECT_LT((result.values.row(v) - linear(mesh.position(v), 8)).cwiseAbs().maxCoeff(), 1e-7);
}

TEST(LsMesh, AVertexWithThousandsOfNeighbours) {
  // A flat disc of two rings around one vertex, whose row couples each of its neighbours with each.
  // With the outer ring and every third vertex of the inner one fixed to a linear function, that is
  // what has no energy at the hub: the rest is nearly linear.
  constexpr Index kAround = 3000;
  std::vector<Vec3> positions = {Vec3::Zero()};
  std::vector<Face> faces;
  const auto number = [](Index ring, Index k) { return 1 + ring * kAround + k % kAround; };
  for (Index ring = 0; ring < 2; ++ring)
    for (Index k = 0; k < kAround; ++k) {
      const double angle = 2.0 * 3.14159265358979 * k / kAround;
      const double radius = ring == 0 ? 1.0 : 1.01;
      positions.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0.0);
      if (ring == 0) {
        faces.push_back({0, number(0, k), number(0, k + 1)});
      } else {
        faces.push_back({number(0, k), number(1, k), number(1, k + 1)});
        faces.push_back({number(0, k), number(1, k + 1), number(0, k + 1)});
      }
    }
  std::vector<Index> fixed;
  for (Index k = 0; k < kAround; ++k) fixed.push_back(number(1, k));
  for (Index k = 0; k < kAround; k += 3) fixed.push_back(number(0, k));
  Values fixed_values(static_cast<Eigen::Index>(fixed.size()), 3);
  for (std::size_t k = 0; k < fixed.size(); ++k)
    fixed_values.row(static_cast<Eigen::Index>(k)) = linear(positions[at(fixed[k])], 3);
  LsMeshInput input;
  input.positions = positions;
  input.faces = faces;
  input.fixed = fixed;
  input.fixed_values = &fixed_values;
  Executor executor(1);
  const LsMeshResult result =
      ls_mesh(input, {.tolerance = 1e-6, .most_iterations = 1000}, executor);
  EXPECT_TRUE(result.converged);
  EXPECT_LT((result.values.row(0) - linear(positions[0], 3)).norm(), 0.02);
}

TEST(LsMesh, SameBitsOnAnyNumberOfThreads) {
  const Cloud cloud = random_cloud(3000, 5);
  const std::vector<Index> fixed = every(9, cloud.positions.size());
  Values values(static_cast<Eigen::Index>(fixed.size()), 8);
  for (std::size_t k = 0; k < fixed.size(); ++k)
    values.row(static_cast<Eigen::Index>(k)) =
        linear(cloud.positions[static_cast<std::size_t>(fixed[k])], 8).array().cos();
  const LsMeshInput input = {
      .positions = cloud.positions, .tets = cloud.tets, .fixed = fixed, .fixed_values = &values};
  Executor one(1), three(3);
  const LsMeshResult a = ls_mesh(input, {.most_iterations = 20}, one);
  const LsMeshResult b = ls_mesh(input, {.most_iterations = 20}, three);
  EXPECT_TRUE(a.values == b.values);
}

}  // namespace
}  // namespace mimicry
