#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <mimicry/curve/projected_curve.h>
#include <mimicry/mesh/surface.h>
#include <mimicry/study/motion.h>
#include <mimicry/study/target_set.h>

namespace mimicry {

/// A target curve X as a shape was shown, ready to be compared with. Display coordinates (model
/// coordinates times metres per unit).
struct IntendedCurve {
  double metres_per_unit = 1.0;
  double length_m = 0.0;        ///< L_X, of the full polyline
  std::vector<Vec3> compared;   ///< kComparedPoints at equal arc length
  std::vector<Vec3> keypoints;  ///< in the order of the curve
};

/// Throws Error(invalid_input) where the curve has no length, a face that the mesh has not, or a
/// keypoint beyond its points.
IntendedCurve intended_curve(const TriangleMesh& mesh, const TargetCurve& curve,
                             double metres_per_unit);

/// Reasons for which the paper leaves a stroke out of its analysis (section 6).
struct Filters {
  bool too_short = false;  ///< |Q| below half of L_X
  bool noisy = false;      ///< some |p_i - p_{i-1}| above kNoisyStep_m
  bool inverted = false;   ///< drawn the other way round: `inversions` above l (l + 1) / 4
  bool passed() const { return !too_short && !noisy && !inverted; }
};
inline constexpr double kNoisyStep_m = 0.05;

/// Steps of the hand below this do not count for jumps: tracking does not see them.
inline constexpr double kLeastStep_m = 1e-5;
/// A curve that moves this many times as far as the hand jumps.
inline constexpr double kJumpRatio = 5.0;

/// What is measured of one stroke. Q is the polyline of the curve's points, pieces joined by one
/// straight step; Q^ its refinement with all edge crossings, pieces joined by a geodesic; both and
/// X are compared at kComparedPoints points at equal arc length. Lengths are world lengths. The
/// first ten are the paper's (section 6), with its letters.
struct Measures {
  double d_ep_m = 0.0;         ///< mean |q_i - x_i|
  double d_sym_m = 0.0;        ///< half the sum of the mean closest distances each way
  double k_e_rad_per_m = 0.0;  ///< turning angles of Q^ in space, sum / L_X
  double k_g_rad_per_m = 0.0;  ///< |deviation from a straightest geodesic|, sum / L_X
  double f_g_rad_per_m = 0.0;  ///< |change of the deviation from node to node|, sum / L_X
  double t_h = 0.0;            ///< path of the head / L_X
  double r_h_rad_per_m = 0.0;  ///< rotation of the head / L_X
  double t_c = 0.0;            ///< path of the controller / L_X
  double r_c_rad_per_m = 0.0;  ///< rotation of the controller / L_X
  double tau_s = 0.0;          ///< from the first to the last frame

  Filters filters;
  double mimicry_violation = 0.0;  ///< (largest - smallest |p_i - x_i|) / L_X
  double l_x_m = 0.0;              ///< L_X

  // Ours.
  /// Polthier and Schmies' other curvature: deviations at vertices in parts of 2 pi, sum / L_X.
  double k_g_normalised_rad_per_m = 0.0;
  double largest_jump = 0.0;   ///< largest |dq| / |dp| of joined frames whose |dp| >= kLeastStep_m
  double share_jumping = 0.0;  ///< of those frames, the part above kJumpRatio; 0 to 1
  std::size_t gaps = 0;        ///< places where the curve is broken
  double frechet_m = 0.0;      ///< discrete Frechet distance of the compared points
  double end_lag_m = 0.0;      ///< |q_end - x_end|
  double length_ratio = 0.0;   ///< |Q| / L_X
  std::size_t boundary_nodes = 0;   ///< of Q^ at which no deviation is defined: the boundary,
  std::size_t undefined_nodes = 0;  ///< and non-manifold places
};

struct MeasureOptions {
  /// False: K_E, K_g and F_g are sums over the pieces, and what joins them does not count.
  bool join_pieces = true;
};

/// All measures of a curve and of the motion that drew it. curve: model units, on `mesh`; its
/// points' `frame` counts in `motion` (kNone: no part in the jumps). motion: display coordinates.
/// Throws Error(invalid_input) for a curve without points, motion without frames, and a time that
/// is not finite or runs backwards. About 1 ms for 400 frames.
Measures measure(const Surface& surface, const IntendedCurve& intended, const ProjectedCurve& curve,
                 std::span<const MotionSample> motion, const MeasureOptions& options = {});

/// The curve with its gaps closed by shortest paths (chords where the surface does not join the
/// points).
ProjectedCurve joined(const ProjectedCurve& curve, const Surface& surface);

}  // namespace mimicry
