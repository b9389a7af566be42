#pragma once

#include <optional>

#include "technique/steps.h"

namespace mimicry {

/// Of the diagonal: a pen this near to the surface lies on it. Twice the 1e-6 that is promised, so
/// that rounding of positions does not decide.
inline constexpr double kTouching = 2e-6;

/// The point of a ray that starts at the pen, direction: any length.
/// - A pen on the surface (kTouching) is the point itself: its ray would start on either side by
///   rounding, and would go through to the far side from one of them.
/// - Where `dipped_pen` is set, a pen inside the object draws at the surface that it went through
///   (`surface_dipped_through`).
/// - Else the ray's first hit.
/// hint: a face that is probably near, or kNone.
TechniqueStep pen_ray(const Canvas& canvas, const Frame& frame, const Vec3& direction, Index hint,
                      const SightOptions& options);

/// The point along the nozzle, with which anchored techniques start.
template <class OwnMemory>
Stepped<OwnMemory> spray(const Canvas& canvas, const OwnMemory& memory, const Frame& frame,
                         const SprayOptions& options) {
  const Vec3 direction = frame.controller.orientation * options.nozzle;
  return stepped(pen_ray(canvas, frame, direction, face_hint(memory), options), memory, frame);
}

/// The surface that a pen went through which is inside the object: where the closest point faces
/// away from the pen and the sight line from pen to head leaves the object. It is the closest
/// point, or, where that faces away from both the head and the pen's direction (the far side of a
/// plate), the end of the sight line. nullopt where the pen is not inside. O(log #F), no
/// allocation.
std::optional<SurfacePoint> surface_dipped_through(const Target& target, const Frame& frame,
                                                   const Vec3& direction, Index hint);

}  // namespace mimicry
