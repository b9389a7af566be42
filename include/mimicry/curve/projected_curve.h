#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <mimicry/mesh/crossing.h>
#include <mimicry/mesh/surface_point.h>
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

}  // namespace mimicry
