#pragma once

#include <cstdint>
#include <limits>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace mimicry {

using Vec2 = Eigen::Vector2d;
using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;
using Quat = Eigen::Quaterniond;

/// Number of a vertex, face, half-edge or frame, 0-based; kNone where there is none.
using Index = std::int32_t;
inline constexpr Index kNone = -1;

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace mimicry
