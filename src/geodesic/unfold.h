#pragma once

#include <algorithm>
#include <cmath>

#include <mimicry/base/types.h>

namespace mimicry {

/// Where a face's third corner q lies in the plane of an exponential map whose centre is its
/// origin, when a and b, counter-clockwise after q, lie at place_a and place_b: the centre is
/// unfolded from their distances; the direction divides theirs as the angle at the centre (Melvaer
/// and Reimers 2012). False where the way from the centre does not cross the edge from a to b.
inline bool unfolded_place(const Vec2& place_a, const Vec2& place_b, const Vec3& a, const Vec3& b,
                           const Vec3& q, Vec2& place) {
  constexpr double kRounding = 1e-9;
  // From s to t, counter-clockwise positive.
  const auto angle = [](const Vec2& s, const Vec2& t) {
    return std::atan2(s.x() * t.y() - s.y() * t.x(), s.dot(t));
  };
  const double to_a = place_a.norm();
  const double to_b = place_b.norm();
  const Vec3 edge = b - a;
  const double e = edge.norm();
  if (!(to_a > 0.0 && to_b > 0.0 && e > 0.0)) return false;
  const Vec3 side = q - a;
  const double qx = side.dot(edge) / e;
  const double qy = side.cross(edge).norm() / e;
  const double sx = (to_a * to_a - to_b * to_b + e * e) / (2.0 * e);
  const double square = to_a * to_a - sx * sx;
  if (!(square > 0.0)) return false;
  const double sy = std::sqrt(square);
  const double crossed = sx + (qx - sx) * (sy / (sy + qy));
  if (!(crossed >= -kRounding * e && crossed <= (1.0 + kRounding) * e)) return false;
  const double angle_b = angle(Vec2(-sx, sy), Vec2(e - sx, sy));
  const double angle_q = angle(Vec2(-sx, sy), Vec2(qx - sx, qy + sy));
  const double between = angle(place_a, place_b);
  // The centre lies beyond the edge as seen from the new vertex, unless two ways around it meet.
  if (!(between < 0.0 && between > -2.0) || angle_b == 0.0) return false;
  const double turn = between * std::clamp(angle_q / angle_b, 0.0, 1.0);
  const double distance = std::hypot(qx - sx, qy + sy);
  const Vec2 direction = place_a / to_a;
  place = distance * Vec2(direction.x() * std::cos(turn) - direction.y() * std::sin(turn),
                          direction.x() * std::sin(turn) + direction.y() * std::cos(turn));
  return true;
}

}  // namespace mimicry
