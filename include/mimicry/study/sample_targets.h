#pragma once

#include <cstddef>
#include <numbers>
#include <string>
#include <vector>

#include <mimicry/base/parallel.h>
#include <mimicry/base/random.h>
#include <mimicry/embedding/smooth_projector.h>
#include <mimicry/study/target_set.h>

namespace mimicry {

/// Target curves <n, i_0, k_G, k_N> (paper, appendix B). The ranges are the paper's; i_0 is drawn
/// from all vertices, k_G and k_N evenly from their ranges.
struct TargetSampling {
  Index controls = 6;       ///< n, at least 4
  double least_k_g = 0.05;  ///< geodesic distance between controls, in diagonals
  double most_k_g = 0.25;
  double least_k_n_rad = std::numbers::pi / 6;  ///< angle between the controls' normals
  double most_k_n_rad = 5 * std::numbers::pi / 12;
  Index points = 501;       ///< of each curve, at even parameters; at least 2
  int most_attempts = 100;  ///< for one curve, before it is given up
};

/// Control points C_1 = first, C_i the vertex with the least
/// (d_G(C_{i-1}, v) - k_G)^2 + (d_N(C_{i-1}, v) - k_N)^2 among those farther than k_G / 2 from all
/// earlier ones: d_G the exact geodesic distance in diagonals, d_N the angle between vertex
/// normals; of equals the lowest number. Fewer than `count` where no vertex is left. count searches
/// from one vertex to all.
std::vector<Index> control_points(const Target& target, Index first, Index count, double k_g,
                                  double k_n_rad);

/// Attempts by what became of them.
struct SamplingCounts {
  std::size_t accepted = 0;
  std::size_t no_controls = 0;    ///< no vertex was left far enough from the others
  std::size_t jumps = 0;          ///< the spline is not continuous on the surface
  std::size_t self_crossing = 0;  ///< the curve meets itself
};

struct SampledTargets {
  std::vector<TargetCurve> curves;  ///< with parameters and keypoints
  SamplingCounts counts;
};

/// `count` target curves: cubic B-splines on the surface (`clamped_b_spline_curve`) that start and
/// end in their first and last control. Refused and drawn anew are splines with a step on the
/// surface longer than a twentieth of their length or none at all, and curves that meet themselves
/// (`self_crossing`). metres_per_unit is for the keypoints. Throws Error(invalid_input) for
/// options out of range and where most_attempts do not give a curve, Error(cancelled). Equal
/// arguments give equal curves.
SampledTargets sample_targets(const SmoothProjector& projector, double metres_per_unit,
                              std::size_t count, const TargetSampling& options, Random random,
                              const ProgressCallback& progress = {});

}  // namespace mimicry
