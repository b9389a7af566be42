#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <mimicry/mesh/half_edges.h>
#include <mimicry/mesh/surface.h>
#include <mimicry/mesh/triangle_mesh.h>

namespace mimicry {

/// A point that a technique inked. All in the target's coordinates and units.
struct CurvePoint {
  SurfacePoint surface;
  Vec3 position = Vec3::Zero();
  Vec3 normal = Vec3::Zero();  ///< unit, vertex normals interpolated
  Index frame = kNone;         ///< number of the stroke's frame that it came from
  double time_s = 0.0;         ///< that frame's time
  double pen_distance = 0.0;   ///< from the pen's tip
};

enum class PieceKind : std::uint8_t {
  same_face,         ///< straight inside one face
  shortest,          ///< the shortest path on the surface
  locally_shortest,  ///< a straight path on the surface; the search for a shorter one was given up
  chord,             ///< straight through space: the surface does not join the points
  gap,               ///< nothing is drawn: the curve was broken here
};

/// What joins point i to point i + 1.
struct Piece {
  PieceKind kind = PieceKind::gap;
  double length = 0.0;               ///< model units; 0 for a gap
  std::uint32_t first_crossing = 0;  ///< into ProjectedCurve::crossings
  std::uint32_t crossing_count = 0;
};

/// A curve on the surface: points and, between each two, a piece with every edge that it crosses,
/// so that a reader can go on without the mesh search. Plain data; made by `CurveBuilder`.
struct ProjectedCurve {
  std::vector<CurvePoint> points;
  std::vector<Piece> pieces;        ///< one fewer than points (none for no point)
  std::vector<Crossing> crossings;  ///< of all pieces, in order
  bool closed = false;              ///< it ends in its first point

  std::span<const Crossing> piece_crossings(std::size_t piece) const {
    return std::span(crossings).subspan(pieces[piece].first_crossing, pieces[piece].crossing_count);
  }
};

/// Sum of the pieces' lengths, model units. O(pieces).
double length(const ProjectedCurve& curve);

/// The curve as polylines with all crossings, one for each part between gaps; model units. A part
/// of a single point is a polyline of that point.
std::vector<std::vector<Vec3>> polylines(const ProjectedCurve& curve, const TriangleMesh& mesh);

/// Moves a curve with its target after the target's vertices have moved: positions, normals and
/// lengths from the faces, barycentrics and crossings, which stay. O(points + crossings).
/// vertex_normals: #V by 3, unit.
void follow(ProjectedCurve& curve, const TriangleMesh& mesh, std::span<const Vec3> vertex_normals);

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
/// the mesh (crossings of another mesh). O(points + crossings).
RefinedCurve refine(const ProjectedCurve& curve, const Surface& surface);

/// The point at length s along a curve, straight within each segment. Gaps and chords have no
/// length on the surface and are stepped over: where one is met the end of its first side. s in
/// [0, length], what lies outside is taken for the nearer end. The curve has a point. O(log nodes).
SurfacePoint point_at_length(const RefinedCurve& curve, const TriangleMesh& mesh, double s);
/// The same in one call; O(points + crossings).
SurfacePoint point_at_length(const ProjectedCurve& curve, const Surface& surface, double s);

/// `count` points at equal steps of length along the curve, from its first to its last point (of a
/// closed curve the same); a single one is the first. Gaps and chords as above. None for a curve
/// without points. O(points + crossings + count log).
std::vector<SurfacePoint> resample(const ProjectedCurve& curve, const Surface& surface,
                                   std::size_t count);

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
