#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "phong/tangent_bases.h"
#include "spatial/bvh.h"
#include "spatial/lanes.h"

namespace mimicry {

/// A triangle in R^8, for a hierarchy.
struct Triangle8 {
  class Pack;

  std::array<const Vec8*, 3> corners;

  Eigen::AlignedBox<double, kDimension> box() const {
    const auto [x0, x1, x2] = corners;
    return {x0->cwiseMin(*x1).cwiseMin(*x2), x0->cwiseMax(*x1).cwiseMax(*x2)};
  }
};

/// Four of them side by side, each in coordinates of its own plane, as a sieve in float: what it
/// drops is surely farther than the bound, all rounding allowed for; what it keeps may be, too. It
/// does not hold the triangles themselves: visitors get a number only.
class Triangle8::Pack {
 public:
  void set(int lane, const Triangle8& triangle) {
    const Vec8 &x0 = *triangle.corners[0], a = *triangle.corners[1] - x0,
               b = *triangle.corners[2] - x0;
    const double along = a.norm();
    const Vec8 axis0 = along > 0.0 ? Vec8(a / along) : Vec8(Vec8::Zero());
    const double across = axis0.dot(b);
    Vec8 axis1 = b - across * axis0;
    axis1 -= axis0.dot(axis1) * axis0;  // a thin triangle's leans by rounding
    const double height = axis1.norm();
    if (height > 0.0) axis1 /= height;
    for (Eigen::Index k = 0; k < kDimension; ++k) {
      const auto i = static_cast<std::size_t>(k);
      first_[i][lane] = x0[k];
      axis_[0][i][lane] = static_cast<float>(axis0[k]);
      axis_[1][i][lane] = static_cast<float>(axis1[k]);
    }
    along_[lane] = static_cast<float>(along);
    right_.set(lane, across - along, height);
    left_.set(lane, across, height);
  }
  NoPack get(std::size_t) const { return {}; }

  class NearSieve {
   public:
    /// scale: y and the triangles, scaled, are a few hundred large at most.
    NearSieve(const Vec8& y, double scale) : scale_(splat(static_cast<float>(scale))) {
      for (std::size_t k = 0; k < kDimension; ++k)
        for (int lane = 0; lane < 4; ++lane) y_[k][lane] = y[static_cast<Eigen::Index>(k)];
    }
    /// bound2: squared, scaled, rounded up.
    void set_bound(float bound2) { bound2_ = splat(bound2); }

   private:
    friend class Pack;
    std::array<Double4, kDimension> y_;
    Float4 scale_, bound2_;
  };

  /// Bit k is clear only where triangle k is farther than the bound.
  unsigned candidates(const NearSieve& sieve) const {
    const Float4 zero = splat(0.0F);
    Float4 v2 = zero, s = zero, t = zero;
    for (std::size_t k = 0; k < kDimension; ++k) {
      // Subtracted in double, so that only the result's own size counts for its rounding.
      const Float4 v = to_float(sieve.y_[k] - first_[k]) * sieve.scale_;
      v2 += v * v;
      s += v * axis_[0][k];
      t += v * axis_[1][k];
    }
    const Float4 above2 = max(v2 - s * s - t * t, zero);
    // The foot in the plane; the corners are (0, 0), (along, 0), (across, height).
    const Float4 along = along_ * sieve.scale_, beyond = s - along;
    const Float4 right = right_.turn_y * beyond - right_.turn_x * t,
                 left = left_.turn_x * t - left_.turn_y * s;
    const Float4 to_side2 = min(
        to_segment2(-t, s, along),
        min(to_segment2(right, right_.turn_x * beyond + right_.turn_y * t,
                        right_.length * sieve.scale_),
            to_segment2(left, left_.turn_x * s + left_.turn_y * t, left_.length * sieve.scale_)));
    const Float4 outside2 = select(max(max(-t, right), left) > zero, to_side2, zero);
    const Float4 rounding = splat(kRounding) * (v2 + along * along);
    return bits(above2 + outside2 - rounding <= sieve.bound2_);
  }

 private:
  // More than twenty steps of a float: of the longest chain of operations here.
  static constexpr float kRounding = 4e-6F;

  struct Side {
    Float4 length, turn_x, turn_y;  // its direction: unit length, or zero

    void set(int lane, double x, double y) {
      const double size = std::sqrt(x * x + y * y), scale = size > 0.0 ? 1.0 / size : 0.0;
      length[lane] = static_cast<float>(size);
      turn_x[lane] = static_cast<float>(scale * x);
      turn_y[lane] = static_cast<float>(scale * y);
    }
  };
  // Squared distance from a point `off` the segment's line, `at` from its start.
  static Float4 to_segment2(Float4 off, Float4 at, Float4 length) {
    const Float4 past = max(max(-at, at - length), splat(0.0F));
    return off * off + past * past;
  }

  std::array<Double4, kDimension> first_;
  std::array<std::array<Float4, kDimension>, 2> axis_;
  Float4 along_;
  Side right_, left_;
};

}  // namespace mimicry
