#pragma once

#include <cstddef>
#include <vector>

#include <mimicry/curve/projected_curve.h>
#include <mimicry/mesh/surface.h>

namespace mimicry {

/// A barycentric coordinate below this puts a point of a refined curve on the edge or vertex.
inline constexpr double kSnap = 1e-7;

/// A point of a curve or a place where it crosses an edge.
struct RefinedNode {
  SurfacePoint point;  ///< snapped: on an edge or vertex exactly, or farther than `kSnap` from it
  Vec3 position = Vec3::Zero();
  double length = 0.0;  ///< along the surface from the curve's start, model units
};

/// A curve as straight segments that each lie in one face.
struct RefinedCurve {
  std::vector<RefinedNode> nodes;
  /// #nodes; the face that holds the segment from a node to the next, kNone at the last node of
  /// each part. Of a segment along an edge either of its faces.
  std::vector<Index> faces;
  std::vector<std::size_t> parts;        ///< first node of each part, in order
  std::vector<std::size_t> point_nodes;  ///< #points; the node that each point of the curve became
  bool closed = false;                   ///< the last node is the first again
};

/// All points and crossings of a curve. Points and crossings that lie closer than `kSnap` to an
/// edge or vertex are moved there, what then is the same place twice is one node, and a crossing of
/// an edge that the piece starts or ends on is that end: near an edge a rounding would otherwise
/// count as a turn. Gaps and chords part the curve, and so do pieces that are not connected over
/// the mesh (crossings of another mesh). half_edges belong to mesh. O(points + crossings).
RefinedCurve refine(const ProjectedCurve& curve, const Surface& surface);

}  // namespace mimicry
