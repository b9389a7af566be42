#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <mimicry/base/types.h>

namespace mimicry {

/// Points at which curves are compared (paper, section 6).
inline constexpr int kComparedPoints = 101;

double polyline_length(std::span<const Vec3> points);

/// `count` points (>= 2) at equal arc length from the first to the last point, linearly between. A
/// polyline without length gives copies of its first point; one without points gives none.
std::vector<Vec3> resample(std::span<const Vec3> points, int count);

/// D_ep: mean |q_i - x_i| over kComparedPoints corresponding points of both polylines, in their
/// unit (paper, section 6). NaN where either has no points.
double mean_corresponding_distance(std::span<const Vec3> drawn, std::span<const Vec3> intended);

// Of points that correspond by their number; as many in `drawn` as in `intended`, at least one.

/// Mean |q_i - x_i|.
double mean_distance(std::span<const Vec3> drawn, std::span<const Vec3> intended);
/// Largest less smallest |q_i - x_i|: 0 for a translated copy. By L_X the mimicry violation.
double distance_spread(std::span<const Vec3> drawn, std::span<const Vec3> intended);

// Of two sets of points, at least one in each.

/// D_sym: half the sum of the mean closest distances from each to the other. O(#drawn #intended).
double symmetric_distance(std::span<const Vec3> drawn, std::span<const Vec3> intended);
/// Discrete Frechet distance (Eiter and Mannila 1994): the shortest leash with which two walkers
/// step along both point sequences and never back. O(#drawn #intended).
double frechet_distance(std::span<const Vec3> drawn, std::span<const Vec3> intended);

/// Pairs of keypoints whose closest points of the polyline (of equally close ones the first) stand
/// in the wrong order. 0 to l (l + 1) / 2 for l + 1 keypoints.
std::size_t inversions(std::span<const Vec3> drawn, std::span<const Vec3> keypoints);

}  // namespace mimicry
