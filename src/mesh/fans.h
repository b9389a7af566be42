#pragma once

#include <vector>

#include <mimicry/mesh/triangle_mesh.h>

#include "mesh/kept_faces.h"
#include "mesh/place_edges.h"

namespace mimicry {

/// Which faces are neighbours, and which corners are one vertex of the surface; all #H = 3 #F.
/// Corner 3 f + k is that of the face's own order; half-edge h leaves corner h.
struct Fans {
  std::vector<Index> twins;  ///< the half-edge of the face across, or kNone
  std::vector<Index> fan;    ///< the lowest corner of those that a vertex has
};

/// Pairs the half-edges at each edge (`connect` has the rules), then opens pairs until no two edges
/// run between the same two fans: neighbours can be told by their vertices alone.
Fans find_fans(const TriangleMesh& mesh, const std::vector<Index>& place, const PlaceEdges& edges,
               const KeptFaces& faces);

}  // namespace mimicry
