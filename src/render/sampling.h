#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

#include <mimicry/base/types.h>

namespace mimicry::render {

/// A well-mixed 32-bit number from a number, for sampling that depends on the pixel alone.
inline std::uint32_t mix(std::uint32_t x) {
  x ^= x >> 16;
  x *= 0x21f0aaadU;
  x ^= x >> 15;
  x *= 0x735a2d97U;
  x ^= x >> 15;
  return x;
}

/// Points of a low-discrepancy sequence in the unit cube (multiples of g^-1, g^-2, g^-3 modulo 1
/// with g^4 = g + 1), shifted as a whole by a start. Fixed point: the same on every machine.
class Sequence {
 public:
  /// The same points for every pixel.
  Sequence() = default;
  /// Shifted by a hash of the pixel, so that neighbours' errors are independent and average out.
  Sequence(int x, int y)
      : a_(mix(static_cast<std::uint32_t>(x) * 0x9e3779b9U ^ mix(static_cast<std::uint32_t>(y)))),
        b_(mix(a_ ^ 0x68bc21ebU)),
        c_(mix(b_ ^ 0x02e5be93U)) {}

  /// The i-th point, components in [0, 1).
  Eigen::Vector3f operator()(std::uint32_t i) const {
    return {unit(a_ + i * 3518319155U), unit(b_ + i * 2882110345U), unit(c_ + i * 2360945575U)};
  }

 private:
  static float unit(std::uint32_t x) { return static_cast<float>(x >> 8) * 0x1p-24F; }
  std::uint32_t a_ = 1U << 31, b_ = 1U << 31, c_ = 1U << 31;
};

/// From [0, 1) to (-1, 1), densest around 0 (a tent).
inline float tent(float u) {
  return u < 0.5F ? std::sqrt(2.0F * u) - 1.0F : 1.0F - std::sqrt(2.0F - 2.0F * u);
}

/// Cosine-weighted direction around the unit vector n, from two numbers in [0, 1).
inline Eigen::Vector3f cosine_direction(const Eigen::Vector3f& n, float u, float v) {
  // Branchless frame (Duff et al., Building an Orthonormal Basis, Revisited, 2017).
  const float sign = std::copysign(1.0F, n.z());
  const float a = -1.0F / (sign + n.z());
  const float b = n.x() * n.y() * a;
  const Eigen::Vector3f t(1.0F + sign * n.x() * n.x() * a, sign * b, -sign * n.x());
  const Eigen::Vector3f s(b, sign + n.y() * n.y() * a, -n.y());
  const float radius = std::sqrt(u);
  const float angle = 2.0F * std::numbers::pi_v<float> * v;
  return radius * std::cos(angle) * t + radius * std::sin(angle) * s + std::sqrt(1.0F - u) * n;
}

}  // namespace mimicry::render
