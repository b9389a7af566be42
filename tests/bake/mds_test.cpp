#include "bake/mds.h"

#include <random>

#include <gtest/gtest.h>

namespace mimicry {
namespace {

Eigen::MatrixXd planted(int n, int dimension, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  Eigen::MatrixXd x(n, dimension);
  for (Eigen::Index k = 0; k < x.size(); ++k) x.data()[k] = normal(random);
  return x;
}

Eigen::MatrixXd distances_of(const Eigen::MatrixXd& x) {
  Eigen::MatrixXd d(x.rows(), x.rows());
  for (Eigen::Index i = 0; i < x.rows(); ++i)
    for (Eigen::Index j = 0; j < x.rows(); ++j) d(i, j) = (x.row(i) - x.row(j)).norm();
  return d;
}

double stress_by_definition(const Eigen::MatrixXd& wanted, const Eigen::MatrixXd& x) {
  const Eigen::MatrixXd d = distances_of(x);
  const double floor = 1e-3 * wanted.maxCoeff();
  double sum = 0.0, total = 0.0;
  for (Eigen::Index i = 0; i < d.rows(); ++i)
    for (Eigen::Index j = 0; j < d.rows(); ++j) {
      if (i == j) continue;
      const double w = 1.0 / std::pow(std::max(wanted(i, j), floor), 2);
      sum += w * std::pow(d(i, j) - wanted(i, j), 2);
      total += w * std::pow(wanted(i, j), 2);
    }
  return std::sqrt(sum / total);
}

TEST(Mds, RecoversAPlantedConfiguration) {
  for (const int dimension : {2, 3, 8}) {
    const Eigen::MatrixXd wanted = distances_of(planted(90, dimension, 3));
    Executor executor;
    const MdsResult result = multidimensional_scaling(wanted, {.dimension = 8}, executor);
    EXPECT_LT(result.stress, 1e-6) << dimension;
    // Rigid motions are all that is left open.
    EXPECT_LT((distances_of(result.positions) - wanted).cwiseAbs().maxCoeff(), 1e-5);
    EXPECT_LT(result.distortion[3], 1e-4);
  }
}

TEST(Mds, StressIsAsDefinedAndLowerThanTheClassicalStart) {
  // Great-circle distances do not fit into any Euclidean space.
  Eigen::MatrixXd x = planted(120, 3, 9);
  x.rowwise().normalize();
  Eigen::MatrixXd wanted(120, 120);
  for (Eigen::Index i = 0; i < 120; ++i)
    for (Eigen::Index j = 0; j < 120; ++j)
      wanted(i, j) = std::acos(std::clamp(x.row(i).dot(x.row(j)), -1.0, 1.0));
  wanted.diagonal().setZero();
  Executor executor;
  const MdsResult start =
      multidimensional_scaling(wanted, {.dimension = 3, .most_iterations = 0}, executor);
  const MdsResult end = multidimensional_scaling(wanted, {.dimension = 3}, executor);
  EXPECT_TRUE(end.converged);
  EXPECT_LT(end.stress, start.stress);
  EXPECT_GT(end.iterations, 3);
  EXPECT_NEAR(end.stress, stress_by_definition(wanted, end.positions), 1e-9);
  EXPECT_LE(end.distortion[0], end.distortion[1]);
  EXPECT_LE(end.distortion[2], end.distortion[3]);
  // A stationary point: small moves of any point do not lower the stress by more than they must.
  Eigen::MatrixXd moved = end.positions;
  moved(5, 1) += 1e-2;
  EXPECT_GT(stress_by_definition(wanted, moved), end.stress);
}

TEST(Mds, SameBitsOnAnyNumberOfThreads) {
  Eigen::MatrixXd wanted = distances_of(planted(200, 5, 4));
  wanted = wanted.cwiseSqrt().eval();
  Executor one(1), three(3);
  const MdsResult a = multidimensional_scaling(wanted, {}, one);
  const MdsResult b = multidimensional_scaling(wanted, {}, three);
  EXPECT_EQ(a.iterations, b.iterations);
  EXPECT_TRUE(a.positions == b.positions);
}

TEST(Mds, SmallAndDegenerateInputs) {
  Executor executor;
  EXPECT_EQ(multidimensional_scaling(Eigen::MatrixXd(0, 0), {}, executor).positions.rows(), 0);
  EXPECT_EQ(multidimensional_scaling(Eigen::MatrixXd::Zero(1, 1), {}, executor).positions.cols(),
            8);
  EXPECT_TRUE(
      multidimensional_scaling(Eigen::MatrixXd::Zero(4, 4), {}, executor).positions.isZero());
  // Two of five points coincide, and the scale is far from 1.
  Eigen::MatrixXd x = planted(5, 3, 8) * 1e7;
  x.row(4) = x.row(1);
  const Eigen::MatrixXd wanted = distances_of(x);
  const MdsResult result = multidimensional_scaling(wanted, {}, executor);
  EXPECT_LT((distances_of(result.positions) - wanted).cwiseAbs().maxCoeff(),
            1e-4 * wanted.maxCoeff());
}

TEST(Mds, Cancels) {
  const Eigen::MatrixXd wanted = distances_of(planted(20, 3, 1));
  Executor executor;
  EXPECT_THROW(
      multidimensional_scaling(wanted, {}, executor, [](const Progress&) { return false; }),
      std::runtime_error);
}

}  // namespace
}  // namespace mimicry
