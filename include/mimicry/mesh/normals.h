#pragma once

#include <span>
#include <vector>

#include <mimicry/mesh/triangle_mesh.h>

namespace mimicry {

/// Unit normal of a face; zero for a face without area.
Vec3 face_normal(const TriangleMesh& mesh, Index f);

/// Unit vertex normals, face normals weighted by the face's angle at the vertex (Thuermer and
/// Wuethrich 1998): independent of how the faces are cut. #V by 3; zero at isolated vertices and
/// where the weighted sum vanishes. O(#V + #F).
std::vector<Vec3> angle_weighted_normals(const TriangleMesh& mesh);
/// The same into an array of #V that is already there; no allocation.
void angle_weighted_normals(const TriangleMesh& mesh, std::span<Vec3> normals);

/// Unit normal at a surface point: vertex normals interpolated, the face's own normal where they
/// cancel.
Vec3 interpolated_normal(const TriangleMesh& mesh, std::span<const Vec3> vertex_normals,
                         const SurfacePoint& p);

}  // namespace mimicry
