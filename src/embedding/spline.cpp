#include "embedding/spline.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

namespace mimicry {
namespace {

using Weights = std::array<double, 4>;

// The four basis functions of a clamped cubic B-spline that are not zero in a span (the triangular
// scheme of Cox and de Boor).
Weights clamped_weights(double t, int span, int spans) {
  const auto knot = [&](int j) { return static_cast<double>(std::clamp(j - 3, 0, spans)); };
  const int i = span + 3;  // t is in [knot(i), knot(i + 1)]
  Weights weights = {1.0, 0.0, 0.0, 0.0};
  for (int degree = 1; degree <= 3; ++degree) {
    double carried = 0.0;
    for (int r = 0; r < degree; ++r) {
      const double right = knot(i + r + 1) - t;
      const double left = t - knot(i + 1 - degree + r);
      const auto k = static_cast<std::size_t>(r);
      const double part = weights[k] / (right + left);
      weights[k] = carried + right * part;
      carried = left * part;
    }
    weights[static_cast<std::size_t>(degree)] = carried;
  }
  return weights;
}

template <class PointAt>
std::vector<SmoothPoint> even_points(std::span<const SurfacePoint> controls, Index points,
                                     PointAt&& point_at) {
  assert(points >= 2);
  std::vector<SmoothPoint> curve;
  curve.reserve(static_cast<std::size_t>(points));
  const double spans = static_cast<double>(controls.size()) - 3.0;
  Index hint = kNone;
  for (Index i = 0; i < points; ++i) {
    const double t = std::min(spans, spans * i / (points - 1));
    curve.push_back(point_at(t, hint));
    hint = curve.back().surface.face;
  }
  return curve;
}

}  // namespace

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
  return even_points(controls, points, [&](double t, Index hint) {
    return b_spline_point(projector, controls, t, hint);
  });
}

SmoothPoint clamped_b_spline_point(const SmoothProjector& projector,
                                   std::span<const SurfacePoint> controls, double t,
                                   Index face_hint) {
  assert(controls.size() >= 4);
  const auto spans = static_cast<int>(controls.size()) - 3;
  assert(t >= 0.0 && t <= spans);
  const int span = std::min(static_cast<int>(t), spans - 1);
  return projector.weighted_average(controls.subspan(static_cast<std::size_t>(span), 4),
                                    clamped_weights(t, span, spans), face_hint);
}

std::vector<SmoothPoint> clamped_b_spline_curve(const SmoothProjector& projector,
                                                std::span<const SurfacePoint> controls,
                                                Index points) {
  return even_points(controls, points, [&](double t, Index hint) {
    return clamped_b_spline_point(projector, controls, t, hint);
  });
}

}  // namespace mimicry
