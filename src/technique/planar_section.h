#include <mimicry/mesh/surface.h>
#pragma once

#include <mimicry/mesh/triangle_mesh.h>

namespace mimicry {

/// q, a hair into its face: a plane through it has corners of the face on both sides and passes a
/// vertex on a definite side.
SurfacePoint drawn_inward(const SurfacePoint& q);

/// The point closest to r on the section of the surface with the plane through q, of the section's
/// component that contains q; a component ends at boundary and non-manifold edges. normal: the
/// plane's, unit. Of equally close points the one met first, walking from q along normal x surface
/// normal. Cost: linear in the faces that the component crosses; no allocation.
SurfacePoint closest_on_section(const Surface& surface, const SurfacePoint& q, const Vec3& normal,
                                const Vec3& r);

}  // namespace mimicry
