#pragma once

#include <optional>

#include <mimicry/spatial/target.h>

namespace mimicry {

/// Barycentric coordinates below this count as on the opposite edge.
inline constexpr double kOnEdge = 1e-9;
/// Of the diagonal: nearer to the surface a difference of positions is rounding.
inline constexpr double kOnSurface = 1e-7;

/// The angle-weighted pseudonormal (Baerentzen and Aanaes 2005), unit length: the face's normal
/// inside a face, the sum of both on an edge, the vertex normal at a vertex. Zero where these
/// vanish.
Vec3 pseudonormal(const Target& target, const SurfacePoint& p);

/// The gradient of the distance to the surface at y: unit, away from the closest point; within
/// kOnSurface of the surface the pseudonormal there. Of the
/// signed distance this is the gradient but for its sign inside. nullopt where y has no closest
/// point. hint: as in Target::closest_point.
std::optional<Vec3> distance_gradient(const Target& target, const Vec3& y, Index hint = kNone);

}  // namespace mimicry
