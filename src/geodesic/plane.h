#pragma once

#include <mimicry/base/types.h>

namespace mimicry {

/// Twice the signed area between two vectors of the plane: positive where b lies to the left of a.
inline double cross(const Vec2& a, const Vec2& b) {
  return a.x() * b.y() - a.y() * b.x();
}

}  // namespace mimicry
