#pragma once

#include <compare>
#include <cstdint>
#include <span>
#include <vector>

#include <mimicry/curve/projected_curve.h>
#include <mimicry/mesh/surface.h>

#include "segment/face_triangulation.h"

namespace mimicry {

/// A place of a curve on the grid of its vertex, edge or face: both faces of an edge see the same.
struct CutPlace {
  enum class Kind : std::uint8_t { vertex, edge, face };
  Kind kind = Kind::vertex;
  Index where = kNone;  // the vertex, the edge (HalfEdges::edge), the face
  CutPoint p;           // edge: x steps from the half-edge's tail; face: as in CutPoint

  auto operator<=>(const CutPlace&) const = default;
};

/// A place and the face that holds the way to the next one; kNone at the end of each part.
struct CutStep {
  CutPlace place;
  Index face = kNone;
};

/// A way through a face that does not run along one of its edges.
struct FaceWay {
  Index face = kNone;
  CutPlace from, to;  // from < to
  auto operator<=>(const FaceWay&) const = default;
};

/// A way along an edge, in grid steps from the half-edge's tail.
struct EdgeWay {
  Index edge = kNone;
  std::int64_t from = 0, to = 0;
  auto operator<=>(const EdgeWay&) const = default;
};

/// All curves by the places that they pass, snapped and merged. Sorted and without repetition but
/// for the curves themselves: it does not depend on their order.
struct CurveNetwork {
  std::vector<std::vector<CutStep>> curves;
  std::vector<CutPlace> edge_places;  // by edge, then along it
  std::vector<CutPlace> face_places;  // by face
  std::vector<FaceWay> face_ways;
  std::vector<EdgeWay> edge_ways;
};

/// Throws Error(invalid_input) as `segment` does for a curve that cannot be cut.
void require_cuttable(const Surface& surface, const ProjectedCurve& curve, std::size_t number,
                      double mesh_diagonal);

/// The curves are cuttable. Throws Error(invalid_input) for edges that are not manifold.
CurveNetwork curve_network(const Surface& surface, std::span<const ProjectedCurve> curves,
                           double snap);

/// Where a place of the face's closure lies in the face.
CutPoint point_in_face(const Surface& surface, Index face, const CutPlace& place);

/// The way between two places on one edge of a face.
EdgeWay edge_way(const Surface& surface, Index face, const CutPlace& a, const CutPlace& b);

}  // namespace mimicry
