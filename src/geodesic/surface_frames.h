#pragma once

#include <cstdint>
#include <vector>

#include <mimicry/mesh/half_edges.h>
#include <mimicry/mesh/triangle_mesh.h>

namespace mimicry {

/// The face of a half-edge laid in the plane: tail at (0, 0), head at (length, 0), the third corner
/// at (apex_x, apex_y), apex_y > 0.
struct EdgeFrame {
  double length = 0.0;
  double apex_x = 0.0;
  double apex_y = 0.0;
  Index edge = kNone;   ///< both half-edges of an edge have the same, 0 to edge_count - 1
  bool forward = true;  ///< this half-edge gives the edge its direction
};

/// A mesh's intrinsic geometry: edge lengths, unfolded faces, angles around vertices.
struct SurfaceFrames {
  SurfaceFrames(const TriangleMesh& mesh, const HalfEdges& half_edges);

  std::vector<EdgeFrame> frames;       // #H
  std::vector<Index> edge_half_edges;  // #E, the forward half-edge
  std::vector<double> start_angles;    // #H, of the half-edge around its tail, counter-clockwise
  std::vector<double> corner_angles;   // #H, of the face at the half-edge's tail
  std::vector<double> total_angles;    // #V
  std::vector<Index> fan_begin;        // #V + 1, into fan
  std::vector<Index> fan;              // #H, half-edges that leave each vertex
  std::vector<std::uint8_t> bends;     // #V, a shortest path may bend here: Bend
  double size = 0.0;                   // diagonal of the bounding box

  enum Bend : std::uint8_t {
    never,    ///< convex, flat
    outside,  ///< into directions at least pi away from where it came from, on both sides
    anywhere  ///< no order of the faces is known (non-manifold), or an edge without length
  };
};

}  // namespace mimicry
