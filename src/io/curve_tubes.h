#pragma once

#include <span>
#include <vector>

#include <mimicry/io/curves.h>

#include "io/tube_mesh.h"

namespace mimicry {

/// Vertex normals of the mesh where a curve of the set is raised; else nothing.
std::vector<Vec3> normals_for_lifts(const CurveSet& set, const TriangleMesh& mesh);

/// The parts of a curve as one mesh. Uses the record's radii, or `radius` where it has none.
/// normals: of `normals_for_lifts`. Throws as `tube_mesh` does, and where there are more radii than
/// points or fewer.
TubeMesh curve_tubes(const CurveRecord& record, const TriangleMesh& mesh, double radius,
                     std::span<const Vec3> normals = {});

}  // namespace mimicry
