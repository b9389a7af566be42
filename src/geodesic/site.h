#pragma once

#include <string_view>

#include <mimicry/mesh/half_edges.h>
#include <mimicry/mesh/triangle_mesh.h>

namespace mimicry {

/// What a surface point lies on. Geodesics leave a vertex into all its faces and an edge into both,
/// whichever face the point happens to name.
struct Site {
  enum class Kind { vertex, edge, face };
  Kind kind = Kind::face;
  Index index = kNone;  ///< the vertex; a half-edge of the point's face; the face
  double t = 0.0;       ///< edge: where along the half-edge, 0 to 1
};

/// A barycentric coordinate at or below this is taken for zero.
inline constexpr double kOnEdge = 1e-10;

/// The site of p, which must be valid (`check_surface_point`).
Site site_of(const TriangleMesh& mesh, const SurfacePoint& p);

/// Whether p is a point of the mesh: its face is one of it and has an area to lie in (no corner
/// twice), its barycentric coordinates are at least -1e-6 and sum to 1 within 1e-6.
bool is_on(const TriangleMesh& mesh, const SurfacePoint& p);

/// Throws Error(invalid_input) that names `what` where p is not on the mesh: a face out of range, a
/// barycentric coordinate that is not finite or below -1e-6, or a sum that is not 1 within 1e-6.
void check_surface_point(const TriangleMesh& mesh, const SurfacePoint& p, std::string_view what);

/// The same point with barycentrics >= 0 that sum to 1.
SurfacePoint normalised(const SurfacePoint& p);

/// A face that holds both points, seen from a, which lies in its face, at an edge also in the face
/// behind it and at a vertex in all around it; kNone where there is none. Of several a's own, then
/// b's own, then the first counter-clockwise. O(faces around a).
Index shared_face(const TriangleMesh& mesh, const HalfEdges& half_edges, const SurfacePoint& a,
                  const SurfacePoint& b);

/// The same point named in another face that holds it (`shared_face`).
SurfacePoint in_face(const TriangleMesh& mesh, const SurfacePoint& p, Index face);

/// The surface point at a vertex, in one of its faces; face kNone for an isolated vertex.
SurfacePoint vertex_point(const HalfEdges& half_edges, Index vertex);

}  // namespace mimicry
