#pragma once

#include <algorithm>
#include <cmath>

#include "technique/section_walk.h"
#include "technique/steps.h"

namespace mimicry {

/// How far the rest fades in half of the time since the anchor's frame. Fading half before and half
/// after the motion makes the curve agree between frame rates to second order in the time step.
inline double half_fade(const SoftAnchor& memory, const Frame& frame,
                        const SoftAnchorOptions& options) {
  return std::exp(-0.5 * (frame.time_s - memory.time_s) / options.soft_anchor_tau_s);
}

/// The longest rest, in mesh units.
inline double longest_rest(const Canvas& canvas, const SoftAnchorOptions& options) {
  return 1e-3 * options.soft_anchor_limit_mm / canvas.metres_per_unit;
}

/// The anchored point r = q + e + dp of this frame: the hand's motion is added to the last point,
/// and with it e, what of the last r the surface did not follow, as far as it has not faded. e is
/// zero without the soft anchor. While the motion dp makes e longer, the limit holds for its mean
/// length over the step, for the same reason as above. The memory is anchored.
inline Vec3 anchored_point(const Canvas& canvas, const SoftAnchor& memory, const Frame& frame,
                           const SoftAnchorOptions& options) {
  const Vec3 motion = frame.controller.position - memory.pen;
  const double rest = memory.rest.norm();
  if (!options.soft_anchor || !(rest > 0.0)) return memory.position + motion;
  const double growth = motion.dot(memory.rest) / rest;
  const double carried = std::min(half_fade(memory, frame, options) * rest,
                                  longest_rest(canvas, options) - 0.5 * growth);
  return memory.position + carried / rest * memory.rest + motion;
}

/// With what is carried over, r can stand where a branch of answers ends, and the answer jumps
/// although the hand hardly moved. A step longer than 4 |dp| and than what kSlide makes in its time
/// goes only that far along the surface; the rest then draws the next ones on to where the jump
/// led.
inline Stepped<SoftAnchor> without_jump(const Canvas& canvas, const SoftAnchor& memory,
                                        const Frame& frame, const SoftAnchorOptions& options,
                                        const Stepped<SoftAnchor>& step) {
  constexpr double kSlide = 0.18;  // metres a second: 2 mm from frame to frame at 90 Hz
  if (!options.soft_anchor || step.answer == Answer::miss) return step;
  const double longest = std::max(4.0 * (frame.controller.position - memory.pen).norm(),
                                  kSlide * (frame.time_s - memory.time_s) / canvas.metres_per_unit);
  const Vec3 way = step.position - memory.position;
  if (!(way.norm() > longest)) return step;
  const Target& target = canvas.target;
  const SurfacePoint end =
      walk_section(target.surface(), memory.surface, way, target.normal(memory.surface), longest);
  return stepped({Answer::section, end, target.position(end)}, memory, frame);
}

/// Keeps what of r the step's point has not followed; `step` comes from `stepped`, `memory`
/// from before.
inline void keep_rest(const Canvas& canvas, const SoftAnchor& memory, const Frame& frame,
                      const SoftAnchorOptions& options, const Vec3& r, Stepped<SoftAnchor>& step) {
  if (!options.soft_anchor || step.answer == Answer::miss) return;
  const double limit = longest_rest(canvas, options);
  const Vec3 rest = half_fade(memory, frame, options) * (r - step.position);
  const double norm = rest.norm();
  step.memory.rest = norm > limit ? Vec3(limit / norm * rest) : rest;
}

/// A step with the soft anchor, long motions in parts of at most kLongestPart: what is carried over
/// then acts at the same places whatever the frame rate. step(memory, frame) makes one part.
template <class OneStep>
Stepped<SoftAnchor> step_in_parts(const Canvas& canvas, const SoftAnchor& memory,
                                  const Frame& frame, const SoftAnchorOptions& options,
                                  OneStep&& step) {
  constexpr double kLongestPart = 0.4e-3;  // metres
  constexpr double kMostParts = 32.0;
  if (!options.soft_anchor) return step(memory, frame);
  const Vec3 motion = frame.controller.position - memory.pen;
  if (!(motion.cwiseAbs().maxCoeff() <= kFarthestHand)) return step(memory, frame);
  const double wanted = motion.norm() * canvas.metres_per_unit / kLongestPart;
  const int parts = static_cast<int>(std::ceil(std::min(std::max(wanted, 1.0), kMostParts)));
  if (parts == 1) return step(memory, frame);
  // The parts bend as the hand does, by its last motion: the chords of 30 Hz are too straight.
  Vec3 bend = memory.points > 1 ? Vec3(motion - memory.motion) : Vec3(Vec3::Zero());
  if (bend.norm() > motion.norm()) bend.setZero();
  Stepped<SoftAnchor> last;
  SoftAnchor at = memory;
  for (int k = 1; k <= parts; ++k) {
    Frame part = frame;
    if (k < parts) {
      const double t = static_cast<double>(k) / parts;
      part.time_s = memory.time_s + t * (frame.time_s - memory.time_s);
      part.controller.position = memory.pen + t * motion - 0.5 * t * (1.0 - t) * bend;
    }
    last = step(at, part);
    if (last.answer == Answer::miss) return miss(memory);
    at = last.memory;
  }
  // To the outside it is one step.
  last.memory.points = memory.points + 1;
  last.memory.motion = motion;
  return last;
}

}  // namespace mimicry
