#pragma once

#include <array>

#include <Eigen/Core>

#include <mimicry/base/parallel.h>

namespace mimicry {

struct MdsOptions {
  int dimension = 8;
  int most_iterations = 300;
  /// Ends when an iteration lowers the squared stress by less than this part of it, twice running.
  double tolerance = 1e-6;
};

struct MdsResult {
  Eigen::MatrixXd positions;  ///< n by dimension, centred
  /// sqrt(sum w (d - D)^2 / sum w D^2), d the distances of `positions`.
  double stress = 0.0;
  /// Of |d / D - 1| over all pairs with D > 0: median, 90 %, 99 %, largest.
  std::array<double, 4> distortion = {};
  int iterations = 0;
  bool converged = true;
};

/// Points whose mutual distances come close to D (n by n, symmetric, finite, >= 0): metric
/// multidimensional scaling with weights w = 1 / D^2 (D at least a thousandth of the largest).
/// Starts from classical scaling (Torgerson 1952); SMACOF (de Leeuw 1977, Guttman transforms) under
/// Anderson acceleration (Anderson 1965, Walker and Ni 2011) that falls back to the plain step
/// whenever the stress would rise. The same bits whatever the number of threads. O(n^3 / 3) once
/// and O(n^2 dimension) an iteration; 4 n^2 doubles.
MdsResult multidimensional_scaling(const Eigen::MatrixXd& distances, const MdsOptions& options,
                                   Executor& executor, const ProgressCallback& progress = {});

}  // namespace mimicry
