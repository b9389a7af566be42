#pragma once

#include <mimicry/base/types.h>

namespace mimicry {

/// A point on a triangle mesh: a face and barycentric coordinates of its three corners, in the
/// face's corner order; they are >= 0 and sum to 1. Every module speaks of points on the surface in
/// this one way.
struct SurfacePoint {
  Index face = kNone;
  Vec3 bary = Vec3::Zero();
};

}  // namespace mimicry
