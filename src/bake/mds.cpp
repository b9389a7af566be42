#include "bake/mds.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>
#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/QR>

#include "bake/morton.h"

namespace mimicry {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Products with rows in fixed blocks: the bits do not depend on the number of threads.
constexpr std::size_t kRows = 64;

// y = a x for a symmetric a, by columns of a.
void multiply_symmetric(const MatrixXd& a, const MatrixXd& x, MatrixXd& y, Executor& executor) {
  y.resize(a.rows(), x.cols());
  executor.for_chunks(
      static_cast<std::size_t>(a.cols()), kRows, [&](std::size_t begin, std::size_t end, int) {
        const auto first = static_cast<Eigen::Index>(begin);
        const auto count = static_cast<Eigen::Index>(end - begin);
        y.middleRows(first, count).noalias() = a.middleCols(first, count).transpose() * x;
      });
}

MatrixXd pseudo_random(Eigen::Index rows, Eigen::Index columns) {
  MatrixXd x(rows, columns);
  for (Eigen::Index k = 0; k < x.size(); ++k)
    x.data()[k] =
        static_cast<double>(mix_bits(static_cast<std::uint64_t>(k)) >> 11) * 0x1p-53 - 0.5;
  return x;
}

// Classical scaling: the leading eigenvectors of -J D^2 J / 2 by subspace iteration. It is a start
// for what follows, so that a few digits are enough.
MatrixXd classical_scaling(const MatrixXd& distances, int dimension, Executor& executor) {
  const Eigen::Index n = distances.rows();
  MatrixXd b = -0.5 * distances.cwiseAbs2();
  const VectorXd mean = b.rowwise().mean();
  b.colwise() -= mean;
  b.rowwise() -= (mean.array() - mean.mean()).matrix().transpose();
  const Eigen::Index width = std::min<Eigen::Index>(n, dimension + 4);
  MatrixXd basis, image = pseudo_random(n, width);
  constexpr int kSweeps = 12;
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    basis = Eigen::HouseholderQR<MatrixXd>(image).householderQ() * MatrixXd::Identity(n, width);
    multiply_symmetric(b, basis, image, executor);
  }
  const MatrixXd small = basis.transpose() * image;
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(0.5 * (small + small.transpose()));
  MatrixXd x = MatrixXd::Zero(n, dimension);
  for (Eigen::Index k = 0; k < std::min<Eigen::Index>(width, dimension); ++k) {
    const Eigen::Index column = width - 1 - k;
    const double value = eigen.eigenvalues()[column];
    if (value > 0.0) x.col(k) = std::sqrt(value) * (basis * eigen.eigenvectors().col(column));
  }
  return x;
}

class Smacof {
 public:
  Smacof(const MatrixXd& distances, Executor& executor)
      : distances_(distances), executor_(executor) {
    const Eigen::Index n = distances.rows();
    constexpr double kFloor = 1e-3;
    const double floor = kFloor * distances.maxCoeff();
    weights_ = distances.cwiseMax(floor).cwiseAbs2().cwiseInverse();
    weights_.diagonal().setZero();
    total_ = weights_.cwiseProduct(distances).cwiseProduct(distances).sum();
    // V = diag(W 1) - W has the constants as its null space; with them filled in it is definite.
    MatrixXd v = -weights_;
    v.diagonal() = weights_.colwise().sum().transpose();
    v.array() += v.diagonal().mean() / static_cast<double>(n);
    solver_.compute(v);
  }

  // The Guttman transform V^+ B(x) x; returns the squared stress of x.
  double transform(const MatrixXd& x, MatrixXd& result) {
    const Eigen::Index n = x.rows();
    result.resize(n, x.cols());
    row_stress_.resize(n);
    executor_.for_chunks(
        static_cast<std::size_t>(n), kRows, [&](std::size_t begin, std::size_t end, int) {
          Eigen::ArrayXd d(n), ratio(n);
          for (auto i = static_cast<Eigen::Index>(begin); i < static_cast<Eigen::Index>(end); ++i) {
            d.setZero();
            for (Eigen::Index k = 0; k < x.cols(); ++k) d += (x.col(k).array() - x(i, k)).square();
            d = d.sqrt();
            const auto wanted = distances_.col(i).array();
            const auto weight = weights_.col(i).array();
            row_stress_[i] = (weight * (d - wanted).square()).sum();
            // Coincident points pull nowhere.
            ratio = weight * wanted / d.max(kTiny);
            result.row(i).noalias() = -(ratio.matrix().transpose() * x);
            result.row(i) += ratio.sum() * x.row(i);
          }
        });
    solver_.solveInPlace(result);
    result.rowwise() -= result.colwise().mean().eval();
    return row_stress_.sum();
  }

  double total() const { return total_; }

 private:
  static constexpr double kTiny = 1e-100;
  const MatrixXd& distances_;
  Executor& executor_;
  MatrixXd weights_;
  Eigen::LLT<MatrixXd> solver_;
  VectorXd row_stress_;
  double total_ = 0.0;
};

// The point that Anderson mixing expects the fixed point of g near, from the last values of x and
// g(x) - x.
class Anderson {
 public:
  MatrixXd next(const MatrixXd& g, const MatrixXd& residual) {
    if (last_residual_.size() != 0) {
      if (static_cast<Eigen::Index>(steps_.size()) == kMemory) {
        steps_.erase(steps_.begin());
        changes_.erase(changes_.begin());
      }
      steps_.push_back(g - last_g_);
      changes_.push_back(residual - last_residual_);
    }
    last_g_ = g;
    last_residual_ = residual;
    if (changes_.empty()) return g;
    const auto m = static_cast<Eigen::Index>(changes_.size());
    MatrixXd gram(m, m);
    VectorXd right(m);
    for (Eigen::Index i = 0; i < m; ++i) {
      const auto& a = changes_[static_cast<std::size_t>(i)];
      right[i] = a.cwiseProduct(residual).sum();
      for (Eigen::Index j = 0; j <= i; ++j)
        gram(i, j) = gram(j, i) = a.cwiseProduct(changes_[static_cast<std::size_t>(j)]).sum();
    }
    constexpr double kRidge = 1e-12;
    gram.diagonal().array() += kRidge * gram.trace();
    if (!(gram.trace() > 0.0)) return g;
    const VectorXd mix = gram.ldlt().solve(right);
    MatrixXd x = g;
    for (Eigen::Index i = 0; i < m; ++i) x -= mix[i] * steps_[static_cast<std::size_t>(i)];
    return x;
  }
  void forget() {
    steps_.clear();
    changes_.clear();
    last_residual_.resize(0, 0);
  }

 private:
  static constexpr Eigen::Index kMemory = 8;
  std::vector<MatrixXd> steps_, changes_;
  MatrixXd last_g_, last_residual_;
};

void measure_distortion(const MatrixXd& distances, MdsResult& result) {
  std::vector<double> distortion;
  const Eigen::Index n = distances.rows();
  distortion.reserve(static_cast<std::size_t>(n * (n - 1) / 2));
  const MatrixXd rows = result.positions.transpose();
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < i; ++j)
      if (distances(j, i) > 0.0)
        distortion.push_back(std::abs((rows.col(i) - rows.col(j)).norm() / distances(j, i) - 1.0));
  if (distortion.empty()) return;
  constexpr std::array<double, 4> kParts = {0.5, 0.9, 0.99, 1.0};
  for (std::size_t k = 0; k < kParts.size(); ++k) {
    const auto place =
        distortion.begin() +
        static_cast<std::ptrdiff_t>(kParts[k] * static_cast<double>(distortion.size() - 1));
    std::nth_element(distortion.begin(), place, distortion.end());
    result.distortion[k] = *place;
  }
}

}  // namespace

MdsResult multidimensional_scaling(const Eigen::MatrixXd& distances, const MdsOptions& options,
                                   Executor& executor, const ProgressCallback& progress) {
  assert(distances.rows() == distances.cols());
  assert(options.dimension >= 1);
  MdsResult result;
  const Eigen::Index n = distances.rows();
  result.positions = MatrixXd::Zero(n, options.dimension);
  if (n < 2 || !(distances.maxCoeff() > 0.0)) return result;

  report(progress, "mds", 0.0);
  // In units of the largest distance: weights stay in range at any scale of the model.
  const double unit = distances.maxCoeff();
  const MatrixXd wanted = distances / unit;
  MatrixXd x = classical_scaling(wanted, options.dimension, executor);
  Smacof smacof(wanted, executor);
  Anderson anderson;
  MatrixXd g, candidate, candidate_g;
  double stress = smacof.transform(x, g);
  const double negligible = 1e-24 * smacof.total();
  int calm = 0;
  result.converged = false;
  for (; result.iterations < options.most_iterations; ++result.iterations) {
    if (stress <= negligible || calm == 2) {
      result.converged = true;
      break;
    }
    report(progress, "mds", static_cast<double>(result.iterations) / options.most_iterations);
    candidate = anderson.next(g, g - x);
    double candidate_stress = smacof.transform(candidate, candidate_g);
    if (!(candidate_stress <= stress)) {
      // A plain Guttman transform never raises the stress.
      anderson.forget();
      candidate = g;
      candidate_stress = smacof.transform(candidate, candidate_g);
    }
    calm = stress - candidate_stress < options.tolerance * stress ? calm + 1 : 0;
    stress = candidate_stress;
    std::swap(x, candidate);
    std::swap(g, candidate_g);
  }
  result.stress = std::sqrt(stress / smacof.total());
  x.rowwise() -= x.colwise().mean().eval();
  result.positions = x * unit;
  measure_distortion(distances, result);
  return result;
}

}  // namespace mimicry
