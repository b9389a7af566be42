#pragma once

#include <span>
#include <vector>

#include <mimicry/base/types.h>

namespace mimicry::study {

/// Points at which curves are compared (paper, section 6).
inline constexpr int kComparedPoints = 101;

double polyline_length(std::span<const Vec3> points);

/// `count` points (>= 2) at equal arc length from the first to the last point, linearly between. A
/// polyline without length gives copies of its first point; one without points gives none.
std::vector<Vec3> resample(std::span<const Vec3> points, int count);

/// D_ep: mean |q_i - x_i| over kComparedPoints corresponding points of both polylines, in their
/// unit (paper, section 6). NaN where either has no points.
double mean_corresponding_distance(std::span<const Vec3> drawn, std::span<const Vec3> intended);

}  // namespace mimicry::study
