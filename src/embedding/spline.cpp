#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include <mimicry/embedding/spline.h>

namespace mimicry::embedding {

SmoothPoint b_spline_point(const SmoothProjector& projector, std::span<const SurfacePoint> controls,
                           double t, Index face_hint) {
  assert(controls.size() >= 4);
  const double spans = static_cast<double>(controls.size() - 3);
  assert(t >= 0.0 && t <= spans);
  const double first = std::min(std::floor(t), spans - 1.0);
  const double u = t - first, v = 1.0 - u;
  const std::array<double, 4> weights = {v * v * v / 6.0, (3.0 * u * u * (u - 2.0) + 4.0) / 6.0,
                                         (3.0 * v * v * (v - 2.0) + 4.0) / 6.0, u * u * u / 6.0};
  return projector.weighted_average(controls.subspan(static_cast<std::size_t>(first), 4), weights,
                                    face_hint);
}

std::vector<SmoothPoint> b_spline_curve(const SmoothProjector& projector,
                                        std::span<const SurfacePoint> controls, Index points) {
  assert(points >= 2);
  std::vector<SmoothPoint> curve;
  curve.reserve(static_cast<std::size_t>(points));
  const double spans = static_cast<double>(controls.size()) - 3.0;
  Index hint = kNone;
  for (Index i = 0; i < points; ++i) {
    const double t = std::min(spans, spans * i / (points - 1));
    curve.push_back(b_spline_point(projector, controls, t, hint));
    hint = curve.back().surface.face;
  }
  return curve;
}

}  // namespace mimicry::embedding
