#pragma once

#include <vector>

#include <mimicry/mesh/triangle_mesh.h>

#include "bake/ls_mesh.h"
#include "bake/shell.h"

namespace mimicry {

/// What makes the values turn their normal direction with the surface.
struct NormalConstraints {
  std::vector<SoftConstraint> constraints;
  Values values;  ///< a row for each
};

/// A least-squares mesh knows of the surface's values but not of its tangent planes: off the
/// surface, values lean along it, by a third of the way on thin parts, and a projection slides as
/// far. For each tetrahedron with a face on the surface: the constraint that the derivative along
/// the surface's normal (interpolated between vertices) in the face's middle be the one that it is
/// in `values`, less its part in the Phong tangent plane there. mesh, shell: centred, with a
/// diagonal of 1; not a lattice. values: #V of the shell by 3 to 8. O(#T).
NormalConstraints normal_constraints(const TriangleMesh& mesh, const Shell& shell,
                                     const Values& values);

}  // namespace mimicry
