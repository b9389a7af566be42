#pragma once

#include <span>

#include "bake/delaunay.h"
#include "bake/ls_mesh.h"

namespace mimicry {

/// Percentage of dihedral angles, 6 per tetrahedron, below 5 or above 175 degrees, measured in the
/// space of the values (any dimension from 3): the paper's "slivers". 0 without tetrahedra; angles
/// at an edge or face that has shrunk to nothing count as slivers.
double sliver_percent(std::span<const Tet> tets, const Values& values);

}  // namespace mimicry
