#pragma once

#include <cmath>

#include <mimicry/base/types.h>

namespace mimicry {

/// No coordinate is infinite or NaN. Unlike Eigen's allFinite it computes nothing, so that it never
/// trips the floating-point traps.
inline bool is_finite(const Vec3& x) {
  return std::isfinite(x[0]) && std::isfinite(x[1]) && std::isfinite(x[2]);
}
inline bool is_finite(const Quat& q) {
  return std::isfinite(q.x()) && std::isfinite(q.y()) && std::isfinite(q.z()) &&
         std::isfinite(q.w());
}

}  // namespace mimicry
