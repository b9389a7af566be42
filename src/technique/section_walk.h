#include <mimicry/mesh/surface.h>
#pragma once

#include <mimicry/mesh/triangle_mesh.h>

namespace mimicry {

/// The end of a walk of `length` (mesh units) from q over the surface, along its section with the
/// plane through q that `motion` and `normal` span, starting in the direction of motion's part
/// across the normal. It stops at a boundary or non-manifold edge and after 4,096 faces; without a
/// plane it stays at q. normal: unit. Cost: linear in the faces crossed; no allocation.
SurfacePoint walk_section(const Surface& surface, const SurfacePoint& q, const Vec3& motion,
                          const Vec3& normal, double length);

}  // namespace mimicry
