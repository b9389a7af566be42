#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include <mimicry/base/types.h>

#include "spatial/lanes.h"

namespace mimicry {

/// Four triangles side by side, with a sieve in float before the exact tests: what it drops is
/// surely missed or surely farther, all rounding of the sieve and of the exact tests allowed for;
/// what it keeps must still be tested.
template <class Triangle>
class TrianglePack {
 public:
  void set(int lane, const Triangle& t) {
    for (int k = 0; k < 3; ++k) {
      const auto axis = static_cast<std::size_t>(k);
      corners_[0][axis][lane] = t.a[k];
      corners_[1][axis][lane] = t.b[k];
      corners_[2][axis][lane] = t.c[k];
    }
  }
  Triangle get(std::size_t lane) const {
    const auto corner = [&](std::size_t c) {
      return Vec3(corners_[c][0][lane], corners_[c][1][lane], corners_[c][2][lane]);
    };
    return {corner(0), corner(1), corner(2)};
  }

  class NearSieve {
   public:
    /// scale: y and the triangles, scaled, are a few hundred large at most.
    NearSieve(const Vec3& y, double scale) : scale_(splat(static_cast<float>(scale))) {
      for (std::size_t k = 0; k < 3; ++k) fill(y_[k], y[static_cast<Eigen::Index>(k)]);
    }
    /// bound2: squared, scaled, rounded up.
    void set_bound(float bound2) { bound2_ = splat(std::min(bound2, 1e30F) * (1.0F + kRounding)); }

   private:
    friend class TrianglePack;
    std::array<Double4, 3> y_;
    Float4 scale_, bound2_;
  };

  /// Bit k is clear only where triangle k lies beyond a plane, across the way to its first corner,
  /// that is farther than the bound.
  unsigned candidates(const NearSieve& sieve) const {
    Float4 way2 = splat(0.0F), ab2 = way2, ac2 = way2, along_ab = way2, along_ac = way2;
    for (std::size_t k = 0; k < 3; ++k) {
      const Float4 way = difference(corners_[0][k], sieve.y_[k]) * sieve.scale_;
      const Float4 ab = difference(corners_[1][k], sieve.y_[k]) * sieve.scale_ - way;
      const Float4 ac = difference(corners_[2][k], sieve.y_[k]) * sieve.scale_ - way;
      way2 += way * way;
      ab2 += ab * ab;
      ac2 += ac * ac;
      along_ab += way * ab;
      along_ac += way * ac;
    }
    const Float4 rounding = splat(kRounding) * (way2 + ab2 + ac2);
    const Float4 least = way2 + min(min(along_ab, along_ac), splat(0.0F)) - rounding;
    return bits((least <= splat(0.0F)) | (least * least <= sieve.bound2_ * way2));
  }

  class RaySieve {
   public:
    /// direction: unit length, inverse_direction finite. size: the largest scaled distance along an
    /// axis from the origin. error: what else the exact test may be off by, scaled.
    RaySieve(const Vec3& origin, const Vec3& direction, const Vec3& inverse_direction, double scale,
             double size, double error)
        : scale_(splat(static_cast<float>(scale))) {
      Eigen::Index z = 0;
      direction.cwiseAbs().maxCoeff(&z);
      const std::array<Eigen::Index, 3> axes = {z == 2 ? 0 : z + 1, z == 0 ? 2 : z - 1, z};
      for (std::size_t k = 0; k < 3; ++k) {
        axes_[k] = static_cast<std::size_t>(axes[k]);
        fill(origin_[k], origin[axes[k]]);
      }
      shear_x_ = splat(static_cast<float>(direction[axes[0]] * inverse_direction[z]));
      shear_y_ = splat(static_cast<float>(direction[axes[1]] * inverse_direction[z]));
      shear_z_ = splat(static_cast<float>(inverse_direction[z]));
      error_ = splat(static_cast<float>(kRounding * size + 4.0 * error));
    }
    /// bound: scaled, rounded up.
    void set_bound(float bound) { bound_ = splat(bound); }

   private:
    friend class TrianglePack;
    std::array<std::size_t, 3> axes_;
    std::array<Double4, 3> origin_;
    Float4 scale_, shear_x_, shear_y_, shear_z_, error_, bound_;
  };

  /// Bit k is clear only where the ray misses triangle k, or meets it beyond the bound or behind
  /// the origin. The test of `Ray::hit` with margins.
  unsigned candidates(const RaySieve& sieve) const {
    std::array<Float4, 3> x, y, z;
    for (std::size_t c = 0; c < 3; ++c) {
      const auto from_origin = [&](std::size_t k) {
        return difference(corners_[c][sieve.axes_[k]], sieve.origin_[k]) * sieve.scale_;
      };
      z[c] = from_origin(2);
      x[c] = from_origin(0) - sieve.shear_x_ * z[c];
      y[c] = from_origin(1) - sieve.shear_y_ * z[c];
    }
    const Float4 u = x[2] * y[1] - y[2] * x[1];
    const Float4 v = x[0] * y[2] - y[0] * x[2];
    const Float4 w = x[1] * y[0] - y[1] * x[0];
    const Float4 largest =
        max(max(max(abs(x[0]), abs(y[0])), max(abs(x[1]), abs(y[1]))), max(abs(x[2]), abs(y[2])));
    // Of two products whose factors are each off by `error_`.
    const Float4 margin = (largest + sieve.error_) * (sieve.error_ * 4.0F + largest * kRounding);
    const Float4 lowest = min(min(u, v), w), highest = max(max(u, v), w);
    for (Float4& depth : z) depth *= sieve.shear_z_;
    const Float4 nearest = min(min(z[0], z[1]), z[2]), farthest = max(max(z[0], z[1]), z[2]);
    return bits(((lowest >= -margin) | (highest <= margin)) & (farthest >= -sieve.error_) &
                (nearest - sieve.error_ <= sieve.bound_));
  }

 private:
  // Eight steps of a float and more: of the longest chain of operations here.
  static constexpr float kRounding = 1e-6F;

  static void fill(Double4& lanes, double x) {
    for (int lane = 0; lane < 4; ++lane) lanes[lane] = x;
  }
  // Subtracted in double, so that only the result's own size counts for its rounding.
  static Float4 difference(const Double4& corner, const Double4& x) { return to_float(corner - x); }

  std::array<std::array<Double4, 3>, 3> corners_;  // by corner and axis
};

}  // namespace mimicry
