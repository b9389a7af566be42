#pragma once

#include <mimicry/mesh/surface.h>

namespace mimicry {

/// The point of the surface that barycentric coordinates of a face mean where some are negative:
/// the face's plane goes on over its edges, as unfolded faces lie in it. Where the surface ends, or
/// a face on the way has no size, the nearest that coordinates without negative ones give.
SurfacePoint over_edges(const Surface& surface, Index face, const Vec3& bary);

}  // namespace mimicry
