#pragma once

#include <functional>
#include <span>
#include <vector>

#include <mimicry/stroke/stroke.h>

namespace mimicry {

/// The polyline that a technique draws from a stroke; any frame, metres.
using ProjectFunction = std::function<std::vector<Vec3>(const Stroke&)>;

/// The stroke with every n-th frame, from the first on, and the last one. n >= 1.
Stroke thinned(const Stroke& stroke, int n);

/// How much a technique's curve depends on the frame rate, metres: the largest mean corresponding
/// distance (`mean_corresponding_distance`) between the curve of the stroke as it is and those of
/// the stroke thinned by each of `divisors` (>= 2). A recording at 90 Hz thus stands for 45 and 30
/// Hz; frames between the recorded ones would have to be invented. Curves without points do not
/// count; NaN where none is left. A projection for each divisor and one more.
double frame_rate_dependence_m(const Stroke& stroke, const ProjectFunction& project,
                               std::span<const int> divisors);

}  // namespace mimicry
