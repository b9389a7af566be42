#pragma once

#include <mimicry/mesh/triangle_mesh.h>

namespace mimicry {

/// Metres a unit at which a mesh of unknown units is shown: its diagonal is 0.6 m. 1 without a
/// size.
inline double shown_metres_per_unit(const TriangleMesh& mesh) {
  constexpr double kShownDiagonal_m = 0.6;
  const double size = diagonal(mesh);
  return size > 0.0 ? kShownDiagonal_m / size : 1.0;
}

}  // namespace mimicry
