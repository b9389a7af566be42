#pragma once

#include <span>
#include <vector>

#include <mimicry/stroke/stroke.h>

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

}  // namespace mimicry
