#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include <mimicry/base/random.h>
#include <mimicry/embedding/smooth_projector.h>

namespace mimicry::bench {

/// How far smooth closest points slide along the surface where the query is moved straight off it
/// (along the interpolated normal, to either side by turns), over the motion: `count` random
/// points, the least first. off: in diagonals; what is not smooth there counts as 1e9.
inline std::vector<double> normal_slides(const SmoothProjector& projector, double off, int count,
                                         std::uint64_t seed) {
  const Target& target = projector.target();
  Random random(seed);
  const double way = off * target.diagonal();
  std::vector<double> slides;
  for (int i = 0; i < count; ++i) {
    SurfacePoint p;
    p.face =
        static_cast<Index>(random.below(static_cast<std::uint32_t>(target.mesh().face_count())));
    const double r = std::sqrt(random.uniform()), s = random.uniform();
    p.bary = Vec3(1.0 - r, r * (1.0 - s), r * s);
    const Vec3 x = target.position(p);
    const auto q = projector.project(x + (i % 2 ? way : -way) * target.normal(p));
    slides.push_back(q->label == ScpLabel::smooth ? (q->position - x).norm() / way : 1e9);
  }
  std::sort(slides.begin(), slides.end());
  return slides;
}

}  // namespace mimicry::bench
