#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <mimicry/curve/projected_curve.h>
#include <mimicry/mesh/surface.h>
#include <mimicry/stroke/stroke.h>
#include <mimicry/study/targets.h>

namespace mimicry {

/// A frame as the measures see it. Positions are *display coordinates*: the model's own, times the
/// metres per unit at which it was shown; so are the directions, which are unit vectors.
struct MotionSample {
  double time_s = 0.0;
  Vec3 head = Vec3::Zero();
  Vec3 head_forward = -Vec3::UnitZ();
  Vec3 head_up = Vec3::UnitY();
  Vec3 pen = Vec3::Zero();  ///< the controller's position, p_i
  Vec3 pen_forward = -Vec3::UnitZ();
  Vec3 pen_up = Vec3::UnitY();
};

/// All frames of a stroke. The stroke is usable (`require_usable`).
std::vector<MotionSample> motion_of(const Stroke& stroke);

/// Width of the Gaussian that motion is filtered with, and where it is cut off.
inline constexpr double kMotionSigma_s = 0.020;
inline constexpr double kMotionCut_s = 0.050;

/// Motion filtered over its own time stamps: each frame becomes the weighted mean of all frames
/// within kMotionCut_s, weights exp(-dt^2 / (2 sigma^2)), sum 1. Up vectors stay unit, forward
/// vectors are made orthogonal to them and unit again; where a mean direction vanishes the frame's
/// own stays. Of frames with equal times only the last is kept. Times are finite and do not
/// decrease. O(frames in the window).
std::vector<MotionSample> filtered(std::span<const MotionSample> motion);

/// How far head and controller moved and turned.
struct MotionLengths {
  double head_m = 0.0;
  double head_rad = 0.0;
  double pen_m = 0.0;
  double pen_rad = 0.0;
};

/// Path lengths as the samples are: sums of the distances between consecutive positions, and of the
/// full rotation angles (0 to pi) that take each (forward, up) frame into the next. T_h, R_h, T_c
/// and R_c are those of the filtered motion by L_X (paper, section 6).
MotionLengths motion_lengths(std::span<const MotionSample> motion);

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
  bool inverted = false;   ///< drawn the other way round: points out of order above l (l + 1) / 4
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

/// How much a measure changes when a task is repeated.
struct Consistency {
  double mean_change = 0.0;   ///< mean |f(i) - f(i')| / f(i); NaN where no pair counts
  std::size_t used = 0;       ///< pairs in the mean
  std::size_t dropped = 0;    ///< changes farther than 5 standard deviations from the mean of all
  std::size_t undefined = 0;  ///< pairs with f(i) not above 0, or a number that is not finite
};

/// first: f(i) of the strokes that were repeated; repeat: f(i') of their repeats; as many. The mean
/// and the standard deviation (n - 1) that decide what is dropped are those of all defined changes
/// (paper, section 6: applied to D_ep and F_g).
Consistency consistency(std::span<const double> first, std::span<const double> repeat);

}  // namespace mimicry
