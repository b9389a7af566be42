#pragma once

#include <vector>

#include <mimicry/io/curves.h>
#include <mimicry/io/tube_mesh.h>

namespace mimicry::io {

/// The parts of a curve as one mesh. Uses the record's radii, or `radius` where it has none.
/// Throws as `tube_mesh` does, and where there are more radii than points or fewer.
TubeMesh curve_tubes(const CurveRecord& record, const TriangleMesh& mesh, double radius);

}  // namespace mimicry::io
