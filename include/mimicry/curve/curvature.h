#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <mimicry/curve/refine.h>
#include <mimicry/mesh/surface.h>

namespace mimicry {

enum class NodeUse : std::uint8_t {
  end,       ///< of a part: nothing turns here
  measured,  ///< both angles are known
  boundary,  ///< a vertex on the boundary: no deviation
  undefined  ///< no deviation: a non-manifold vertex or edge; or a segment without length
};

/// How a curve turns at each node of its refinement, radians; 0 where an angle is not known.
struct CurveCurvature {
  std::vector<NodeUse> uses;       ///< #nodes
  std::vector<double> turning;     ///< #nodes; angle in space between the segments, 0 to pi
  std::vector<double> deviation;   ///< #nodes; from a straightest geodesic, left turns positive
  std::vector<double> normalised;  ///< #nodes; the same, at vertices in parts of 2 pi

  double total_turning = 0.0;
  double total_deviation = 0.0;           ///< signed
  double total_absolute_deviation = 0.0;  ///< K_g is this by the length
  double total_normalised = 0.0;
  double total_absolute_normalised = 0.0;
  std::size_t boundary_nodes = 0;   ///< skipped
  std::size_t undefined_nodes = 0;  ///< skipped
};

/// Turning angle and geodesic curvature at every inner node of every part; the joint of a closed
/// curve counts at its first node. The deviation is the signed angle in a face, the one between the
/// unfolded segments on an edge, and theta / 2 less the angle to the left of the curve at a vertex
/// of total angle theta; `normalised` multiplies the last by 2 pi / theta (Polthier and Schmies
/// 1998, definition 6). At a boundary vertex only the turning angle is known. O(nodes + faces
/// around the vertices passed).
CurveCurvature curvature(const RefinedCurve& curve, const Surface& surface);

}  // namespace mimicry
