#pragma once

#include <span>

#include <mimicry/mesh/half_edges.h>
#include <mimicry/mesh/triangle_mesh.h>

namespace mimicry {

/// The smallest dot product with its faces' normals that a vertex normal is moved to.
inline constexpr double kVisibleDot = 0.3;

/// Moves unit vertex normals (#V, as of `angle_weighted_normals`) so that no vertex sees one of its
/// faces from behind or nearly edge-on: where the smallest dot product with the normals of the
/// incident faces is below kVisibleDot, along the great arc toward the direction for which it is
/// largest, until it is kVisibleDot; all the way where even that direction stays below. Faces
/// without area do not count; at a non-manifold vertex only one fan of its faces does. Zero normals
/// become that direction where it exists. Coordinates below 1e60. Deterministic, no allocation.
/// O(#F) where few vertices need it, 1 to 2 microseconds for each that does.
void make_visible(const TriangleMesh& mesh, const HalfEdges& half_edges, std::span<Vec3> normals);

/// The unit vector whose smallest dot product with unit vectors is largest, and that product. Exact
/// to rounding where up to 24 of them decide (2 or 3 do, but for cones), else the best met; zero
/// for no vectors.
struct MostVisible {
  Vec3 direction = Vec3::Zero();
  double smallest_dot = -1.0;
};
MostVisible most_visible_direction(std::span<const Vec3> unit_vectors);

}  // namespace mimicry
