#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include <mimicry/base/types.h>

#include "base/compiler.h"
#include "spatial/triangle_pack.h"

namespace mimicry {

/// The triangle of the hierarchy over a surface.
struct Triangle {
  using Pack = TrianglePack<Triangle>;
  Vec3 a, b, c;

  Eigen::AlignedBox3d box() const { return {a.cwiseMin(b).cwiseMin(c), a.cwiseMax(b).cwiseMax(c)}; }
};

struct TrianglePoint {
  Vec3 bary;         ///< >= 0, sum 1 to rounding
  double distance2;  ///< squared distance to the query
};

/// The triangle's height is at least 1e-14 of its longest side.
bool has_area(const Triangle& t);

/// Closest point of a triangle to y; infinite distance where the triangle has no area. Needles are
/// safe: their answer is the best of the three sides and the inner point, each judged by its own
/// distance. A corner or, to the last bit in nearly every case, a side gives the same distance to
/// both triangles that share it, so that ties are ties.
TrianglePoint closest_point(const Triangle& t, const Vec3& y);

/// The triangle is farther from y than the squared bound, by more than all rounding in
/// `closest_point`: it lies beyond a plane across the way to one of its corners. A third of the
/// work; false says nothing.
bool is_farther(const Triangle& t, const Vec3& y, double bound2);

/// A ray set up for the watertight test: Woop, Benthin and Wald, Watertight Ray/Triangle
/// Intersection, 2013.
class Ray {
 public:
  /// direction: unit length.
  Ray(const Vec3& origin, const Vec3& direction);
  const Vec3& origin() const { return origin_; }
  const Vec3& direction() const { return direction_; }

  struct Hit {
    double t;  ///< >= 0, along the unit direction
    Vec3 bary;
  };
  /// Where the ray meets the triangle, from either side. Sides and corners belong to the triangle.
  /// Every corner is projected along the ray by a rule that knows nothing of its triangle, and the
  /// sign of each side's determinant is exact (the paper goes from float to double; we from double
  /// to an error-free product), so that no ray passes between two triangles that share a side or
  /// a corner. A triangle that the ray sees edge-on is not hit; its neighbours are.
  std::optional<Hit> hit(const Triangle& triangle) const;

 private:
  Vec3 origin_, direction_;
  int kx_, ky_, kz_;
  double shear_x_, shear_y_, shear_z_;
};

// ---------------------------------------------------------------------------------------------

namespace detail {

// Squared ratios of a triangle's height to its longest side.
inline constexpr double kNoArea2 = 1e-28;  // rounding of the corners decides which way it faces
inline constexpr double kNeedle2 = 1e-6;   // its inner coordinates have lost 3 digits or more

/// Closest point of side pq to y; `weight` is that of q.
struct Side {
  double distance2;
  double weight;
};
inline Side closest_on_side(const Vec3& p, const Vec3& q, const Vec3& y) {
  const Vec3 pq = q - p, py = y - p, qy = y - q;
  const double s = py.dot(pq), r = -qy.dot(pq);
  if (s <= 0.0) return {py.squaredNorm(), 0.0};
  if (r <= 0.0) return {qy.squaredNorm(), 1.0};
  // From the nearer end, so that the neighbour, who sees the side the other way round, computes
  // the same number.
  const Vec3 normal = s <= r ? py.cross(pq) : qy.cross(pq);
  return {normal.squaredNorm() / pq.squaredNorm(), s / (s + r)};
}

/// a b - c d with the exact sign (error-free products), barring underflow.
inline double difference_of_products(double a, double b, double c, double d) {
  const double x = a * b, y = c * d;
  if (x != y) return x - y;  // rounding is monotonic: the sign is right
  return std::fma(a, b, -x) - std::fma(c, d, -y);
}

}  // namespace detail

inline bool has_area(const Triangle& t) {
  const Vec3 ab = t.b - t.a, ac = t.c - t.a, bc = t.c - t.b;
  const double longest2 = std::max({ab.squaredNorm(), ac.squaredNorm(), bc.squaredNorm()});
  return ab.cross(ac).squaredNorm() > detail::kNoArea2 * longest2 * longest2;
}

inline bool is_farther(const Triangle& t, const Vec3& y, double bound2) {
  const Vec3 way = t.a - y, ab = t.b - t.a, ac = t.c - t.a;
  const double way2 = way.squaredNorm();
  const double rounding = 1e-14 * (way2 + ab.squaredNorm() + ac.squaredNorm());
  const double least = way2 + std::min({way.dot(ab), way.dot(ac), 0.0}) - rounding;
  return least > 0.0 && least * least > bound2 * way2;
}

// Inline, so that corners taken from a pack stay in registers.
MIMICRY_INLINE TrianglePoint closest_point(const Triangle& t, const Vec3& y) {
  const Vec3 ab = t.b - t.a, ac = t.c - t.a, bc = t.c - t.b, ay = y - t.a;
  const Vec3 n = ab.cross(ac);
  const double n2 = n.squaredNorm();
  const double longest2 = std::max({ab.squaredNorm(), ac.squaredNorm(), bc.squaredNorm()});
  if (!(n2 > detail::kNoArea2 * longest2 * longest2)) return {Vec3(1, 0, 0), kInfinity};
  const bool is_needle = n2 < detail::kNeedle2 * longest2 * longest2;

  const double v = n.dot(ay.cross(ac)), w = n.dot(ab.cross(ay)), u = n.dot(bc.cross(y - t.b));
  TrianglePoint best = {Vec3(1, 0, 0), kInfinity};
  if (u >= 0.0 && v >= 0.0 && w >= 0.0) {
    best.bary = Vec3(u, v, w) / (u + v + w);
    best.distance2 = (best.bary[1] * ab + best.bary[2] * ac - ay).squaredNorm();
    if (!is_needle) return best;
  }
  // The closest point lies on a side that the query is beyond; a needle's signs are not trusted.
  const auto consider = [&](const Vec3& p, const Vec3& q, int ip, int iq) {
    const detail::Side side = detail::closest_on_side(p, q, y);
    if (side.distance2 >= best.distance2) return;
    best.distance2 = side.distance2;
    best.bary.setZero();
    best.bary[ip] = 1.0 - side.weight;
    best.bary[iq] = side.weight;
  };
  if (w < 0.0 || is_needle) consider(t.a, t.b, 0, 1);
  if (u < 0.0 || is_needle) consider(t.b, t.c, 1, 2);
  if (v < 0.0 || is_needle) consider(t.c, t.a, 2, 0);
  return best;
}

inline Ray::Ray(const Vec3& origin, const Vec3& direction)
    : origin_(origin), direction_(direction) {
  direction.cwiseAbs().maxCoeff(&kz_);
  kx_ = (kz_ + 1) % 3;
  ky_ = (kz_ + 2) % 3;
  shear_z_ = 1.0 / direction[kz_];
  shear_x_ = direction[kx_] * shear_z_;
  shear_y_ = direction[ky_] * shear_z_;
}

inline std::optional<Ray::Hit> Ray::hit(const Triangle& triangle) const {
  const Vec3 a = triangle.a - origin_, b = triangle.b - origin_, c = triangle.c - origin_;
  const double ax = a[kx_] - shear_x_ * a[kz_], ay = a[ky_] - shear_y_ * a[kz_];
  const double bx = b[kx_] - shear_x_ * b[kz_], by = b[ky_] - shear_y_ * b[kz_];
  const double cx = c[kx_] - shear_x_ * c[kz_], cy = c[ky_] - shear_y_ * c[kz_];
  const double u = detail::difference_of_products(cx, by, cy, bx);
  const double v = detail::difference_of_products(ax, cy, ay, cx);
  const double w = detail::difference_of_products(bx, ay, by, ax);
  if ((u < 0.0 || v < 0.0 || w < 0.0) && (u > 0.0 || v > 0.0 || w > 0.0)) return std::nullopt;
  const double sum = u + v + w;
  if (sum == 0.0) return std::nullopt;
  const Vec3 bary = Vec3(u, v, w) / sum;
  const double t = shear_z_ * (bary[0] * a[kz_] + bary[1] * b[kz_] + bary[2] * c[kz_]);
  if (!(t >= 0.0)) return std::nullopt;
  return Hit{t, bary};
}

}  // namespace mimicry
