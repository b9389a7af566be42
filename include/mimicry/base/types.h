#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace mimicry {

using Vec2 = Eigen::Vector2d;
using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;
/// Not aligned beyond its numbers: its size and place in a structure are the same whatever
/// instructions the compiler may use.
using Quat = Eigen::Quaternion<double, Eigen::DontAlign>;

/// Number of a vertex, face, half-edge or frame, 0-based; kNone where there is none.
using Index = std::int32_t;
inline constexpr Index kNone = -1;

/// A number as the index of an array, which it must not be negative for.
constexpr std::size_t at(Index i) {
  return static_cast<std::size_t>(i);
}

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();
inline constexpr double kTau = 2.0 * std::numbers::pi;  // a full turn

/// x -> scale * (rotation * x) + translation. `rotation` is a unit quaternion, `scale` > 0.
struct Similarity {
  Quat rotation = Quat::Identity();
  Vec3 translation = Vec3::Zero();
  double scale = 1.0;

  Vec3 point(const Vec3& x) const { return scale * (rotation * x) + translation; }
  Vec3 inverse_point(const Vec3& x) const {
    return rotation.conjugate() * (x - translation) / scale;
  }
  /// Directions are rotated only: their length stays.
  Vec3 direction(const Vec3& v) const { return rotation * v; }
  Vec3 inverse_direction(const Vec3& v) const { return rotation.conjugate() * v; }
};

}  // namespace mimicry
