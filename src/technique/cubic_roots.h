#pragma once

#include <algorithm>
#include <array>
#include <cmath>

namespace mimicry {

struct CubicRoots {
  int count = 0;
  std::array<double, 3> t{};  ///< increasing
};

/// The roots in [-1, 1] of c0 + c1 t + c2 t^2 + c3 t^3, to a few units of the last place of what
/// the coefficients determine. Between the extrema the polynomial is monotone and a sign change
/// holds one root; so any leading coefficients may vanish, exactly or nearly. Where it only touches
/// zero, to rounding, that counts once. None where all are zero.
inline CubicRoots cubic_roots(double c0, double c1, double c2, double c3) {
  const auto value = [&](double t) { return c0 + t * (c1 + t * (c2 + t * c3)); };
  const auto slope = [&](double t) { return c1 + t * (2.0 * c2 + t * (3.0 * c3)); };
  const double zero = 2e-15 * (std::abs(c0) + std::abs(c1) + std::abs(c2) + std::abs(c3));

  std::array<double, 4> node = {-1.0, 1.0, 1.0, 1.0};
  int nodes = 1;
  const double a = 3.0 * c3, discriminant = c2 * c2 - a * c1;
  if (discriminant > 0.0) {
    const double q = -(c2 + std::copysign(std::sqrt(discriminant), c2));
    double first = 2.0, second = 2.0;  // outside
    if (std::abs(q) < std::abs(a)) first = q / a;
    if (std::abs(c1) < std::abs(q)) second = c1 / q;
    if (first > second) std::swap(first, second);
    if (std::abs(first) < 1.0) node[static_cast<std::size_t>(nodes++)] = first;
    if (std::abs(second) < 1.0) node[static_cast<std::size_t>(nodes++)] = second;
  }
  node[static_cast<std::size_t>(nodes++)] = 1.0;

  CubicRoots roots;
  const auto add = [&](double t) {
    if (roots.count < 3) roots.t[static_cast<std::size_t>(roots.count++)] = t;
  };
  if (!(zero > 0.0)) return roots;
  const auto at_node = [&](double t) {
    const double f = value(t);
    return std::abs(f) <= zero ? 0.0 : f;
  };
  double low = node[0], f_low = at_node(low);
  if (f_low == 0.0) add(low);
  for (int i = 1; i < nodes; ++i) {
    const double high = node[static_cast<std::size_t>(i)], f_high = at_node(high);
    if (f_high == 0.0) {
      add(high);
    } else if (f_low != 0.0 && std::signbit(f_low) != std::signbit(f_high)) {
      // Newton, inside a bracket that shrinks from the side that it comes from.
      double from = low, to = high, t = (low * f_high - high * f_low) / (f_high - f_low);
      for (int k = 0; k < 60; ++k) {
        const double f = value(t);
        if (f == 0.0) break;
        (std::signbit(f) == std::signbit(f_low) ? from : to) = t;
        const double s = slope(t);
        double next = std::abs(f) < std::abs(s) * 4.0 ? t - f / s : 2.0;
        if (!(next > from && next < to)) next = 0.5 * (from + to);
        const double change = std::abs(next - t);
        t = next;
        if (change <= 4e-16) break;
      }
      add(t);
    }
    low = high, f_low = f_high;
  }
  return roots;
}

}  // namespace mimicry
