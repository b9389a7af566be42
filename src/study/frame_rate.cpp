#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include <mimicry/study/recording.h>

#include "study/polyline.h"

namespace mimicry {

Stroke thinned(const Stroke& stroke, int n) {
  assert(n >= 1);
  Stroke result = stroke;
  result.frames.clear();
  for (std::size_t i = 0; i < stroke.frames.size(); ++i)
    if (i % static_cast<std::size_t>(n) == 0 || i + 1 == stroke.frames.size())
      result.frames.push_back(stroke.frames[i]);
  return result;
}

double frame_rate_dependence_m(const Stroke& stroke, const ProjectFunction& project,
                               std::span<const int> divisors) {
  double largest = std::numeric_limits<double>::quiet_NaN();
  const std::vector<Vec3> whole = project(stroke);
  if (whole.empty()) return largest;
  for (const int n : divisors) {
    const std::vector<Vec3> curve = project(thinned(stroke, n));
    if (curve.empty()) continue;
    const double distance = mean_corresponding_distance(curve, whole);
    largest = std::isnan(largest) ? distance : std::max(largest, distance);
  }
  return largest;
}

}  // namespace mimicry
