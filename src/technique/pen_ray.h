#pragma once

#include <optional>

#include "technique/steps.h"

namespace mimicry::technique {

/// Of the diagonal: a pen this near to the surface lies on it. Twice the 1e-6 that is promised, so
/// that rounding of positions does not decide.
inline constexpr double kTouching = 2e-6;

/// The point of a ray that starts at the pen, direction: any length.
/// - A pen on the surface (kTouching) is the point itself: its ray would start on either side by
///   rounding, and would go through to the far side from one of them.
/// - Where `Options::dipped_pen` is set, a pen inside the object draws at the surface that it went
///   through (`surface_dipped_through`).
/// - Else the ray's first hit.
Step pen_ray(const Canvas& canvas, const Memory& memory, const stroke::Frame& frame,
             const Vec3& direction, const Options& options);

/// The surface that a pen went through which is inside the object: where the closest point faces
/// away from the pen and the sight line from pen to head leaves the object. It is the closest
/// point, or, where that faces away from both the head and the pen's direction (the far side of a
/// plate), the end of the sight line. nullopt where the pen is not inside. O(log #F), no
/// allocation.
std::optional<SurfacePoint> surface_dipped_through(const spatial::Target& target,
                                                   const stroke::Frame& frame,
                                                   const Vec3& direction, Index hint);

}  // namespace mimicry::technique
