#pragma once

#include <algorithm>
#include <cmath>

#include "technique/steps.h"

namespace mimicry::technique {

/// The anchored point r = q + e + dp of this frame: the hand's motion is added to the last point,
/// and with it e, what of the last r the surface did not follow, as far as it has not faded. e is
/// zero without the soft anchor. The memory is anchored.
inline Vec3 anchored_point(const Memory& memory, const stroke::Frame& frame,
                           const Options& options) {
  const Vec3 r = memory.position + (frame.controller.position - memory.pen);
  if (options.soft_anchor.on == 0.0) return r;
  const double dt = frame.time_s - memory.time_s;
  return r + std::exp(-dt / options.soft_anchor.tau_s) * memory.rest;
}

/// With what is carried over, r can stand where the nearest branch of answers ends although the
/// hand hardly moved. Such a jump, longer than 4 |dp| and than 2 mm in the world, is not followed:
/// the step is to be taken without the rest.
inline bool is_soft_jump(const Canvas& canvas, const Memory& memory, const stroke::Frame& frame,
                         const Options& options, const Step& step) {
  if (options.soft_anchor.on == 0.0 || step.answer == Answer::miss) return false;
  const double longest = std::max(4.0 * (frame.controller.position - memory.pen).norm(),
                                  2e-3 / canvas.metres_per_unit);
  return (step.position - memory.position).norm() > longest;
}

/// Keeps what of r the step's point has not followed; `step` comes from `ink`.
inline void keep_rest(const Canvas& canvas, const Vec3& r, const Options& options, Step& step) {
  if (options.soft_anchor.on == 0.0) return;
  const double limit = 1e-3 * options.soft_anchor.limit_mm / canvas.metres_per_unit;
  const Vec3 rest = r - step.position;
  const double norm = rest.norm();
  step.memory.rest = norm > limit ? Vec3(limit / norm * rest) : rest;
}

}  // namespace mimicry::technique
