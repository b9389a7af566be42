#pragma once

#include <span>
#include <vector>

#include <mimicry/embedding/smooth_projector.h>

namespace mimicry {

/// The point at parameter t of the uniform (cardinal) cubic B-spline on the surface, by weighted
/// averages (Panozzo et al. 2013, section 5). controls: at least 4; t in [0, #controls - 3], a unit
/// for each span. The curve does not pass through its controls; an end control given three times
/// is an end of the curve.
SmoothPoint b_spline_point(const SmoothProjector& projector, std::span<const SurfacePoint> controls,
                           double t, Index face_hint = kNone);

/// `points` points at even parameters from the first to the last; at least 2.
std::vector<SmoothPoint> b_spline_curve(const SmoothProjector& projector,
                                        std::span<const SurfacePoint> controls, Index points);

/// The point at parameter t of the cubic B-spline that starts in its first control and ends in its
/// last (clamped: uniform knots, the end ones fourfold), by weighted averages. controls: at least
/// 4; t in [0, #controls - 3], a unit for each span.
SmoothPoint clamped_b_spline_point(const SmoothProjector& projector,
                                   std::span<const SurfacePoint> controls, double t,
                                   Index face_hint = kNone);

/// `points` points of it at even parameters; at least 2.
std::vector<SmoothPoint> clamped_b_spline_curve(const SmoothProjector& projector,
                                                std::span<const SurfacePoint> controls,
                                                Index points);

}  // namespace mimicry
