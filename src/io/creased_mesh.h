#pragma once

#include <vector>

#include <mimicry/mesh/triangle_mesh.h>

namespace mimicry {

/// At which faces are shown as edges where files hold normals.
inline constexpr double kCrease_rad = 38.0 / 180.0 * 3.14159265358979323846;

/// A mesh as it is shown: a vertex for each normal that its corners have there.
struct CreasedMesh {
  TriangleMesh mesh;          ///< the same faces in the same order
  std::vector<Vec3> normals;  ///< #V of it, unit
};

/// Smooth but for edges: a corner's normal is that of the faces at its place, weighted by their
/// angles there, which are turned away from its own by less than `crease_rad`. Vertices at equal
/// positions are one place, so that seams of files do not show. A face without area takes the
/// normal of the faces around, and places with more than 256 corners are smooth. O(#F log #F).
CreasedMesh creased_mesh(const TriangleMesh& mesh, double crease_rad);

}  // namespace mimicry
