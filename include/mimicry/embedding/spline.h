#pragma once

#include <span>
#include <vector>

#include <mimicry/embedding/smooth_projector.h>

namespace mimicry::embedding {

/// The point at parameter t of the uniform (cardinal) cubic B-spline on the surface, by weighted
/// averages (Panozzo et al. 2013, section 5). controls: at least 4; t in [0, #controls - 3], a unit
/// for each span. The curve does not pass through its controls; an end control given three times
/// is an end of the curve.
SmoothPoint b_spline_point(const SmoothProjector& projector, std::span<const SurfacePoint> controls,
                           double t, Index face_hint = kNone);

/// `points` points at even parameters from the first to the last; at least 2.
std::vector<SmoothPoint> b_spline_curve(const SmoothProjector& projector,
                                        std::span<const SurfacePoint> controls, Index points);

}  // namespace mimicry::embedding
