#pragma once

#include <mimicry/base/types.h>

namespace mimicry {

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
