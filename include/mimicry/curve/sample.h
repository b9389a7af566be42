#pragma once

#include <cstddef>
#include <vector>

#include <mimicry/curve/refine.h>
#include <mimicry/mesh/surface.h>

namespace mimicry {

/// The point at length s along a curve, straight within each segment. Gaps and chords have no
/// length on the surface and are stepped over: where one is met the end of its first side. s in
/// [0, length], what lies outside is taken for the nearer end. The curve has a point. O(log nodes).
SurfacePoint point_at_length(const RefinedCurve& curve, const TriangleMesh& mesh, double s);
/// The same in one call; O(points + crossings).
SurfacePoint point_at_length(const ProjectedCurve& curve, const Surface& surface, double s);

/// `count` points at equal steps of length along the curve, from its first to its last point (of a
/// closed curve the same); a single one is the first. Gaps and chords as above. None for a curve
/// without points. O(points + crossings + count log).
std::vector<SurfacePoint> resample(const ProjectedCurve& curve, const Surface& surface,
                                   std::size_t count);

}  // namespace mimicry
