#pragma once

#include <mimicry/base/parallel.h>

#include "bake/shell.h"
#include "bake/unit_mesh.h"

namespace mimicry {

/// Takes apart what the shell joins although the surface does not: where two parts of the surface
/// are close in space and far apart on the surface (fingers, the two sides of a plate), tetrahedra
/// between them have corners over both, and values that run from one part to the other within the
/// gap. Each part gets a copy of such a tetrahedron, with copies of the corners that lie over other
/// parts, so that its values go on as if the other part was not there. The copies are the last
/// tetrahedra, `shell.overlapping_tets` of them, their corners the last vertices. Where the parts
/// come together (at the bottom of a fold, at the rim of a plate) the cut ends in corners that all
/// share. The same bits whatever the number of threads.
void separate_sheets(Shell& shell, const UnitSurface& surface, Executor& executor);

}  // namespace mimicry
