#pragma once

#include <string>
#include <vector>

#include <mimicry/base/types.h>
#include <mimicry/mesh/half_edges.h>
#include <mimicry/mesh/triangle_mesh.h>
#include <mimicry/mesh/validation.h>

namespace mimicry {

/// The mesh that a caller gave, seen from the surface that `connect` made of it: both maps between
/// their vertices, and where the corners of faces went. Faces have the same numbers in both.
struct MeshSource {
  std::vector<Face> faces;    ///< #F, as the caller gave them
  std::vector<bool> turned;   ///< #F: corners 1 and 2 are exchanged on the surface
  std::vector<Index> vertex;  ///< #V of the surface: the lowest of the caller's that it joins
  std::vector<Index> surface_vertex;  ///< #V of the caller: one of the surface's; kNone: unused
};

/// A point of the surface with respect to the caller's corners, and back: the same function.
SurfacePoint source_point(const TriangleMesh& surface, SurfacePoint p);

/// The same for a place on an edge: the half-edge 3 f + k runs from the caller's corner k. A place
/// with t = 0 keeps t = 0.
Crossing source_crossing(const TriangleMesh& surface, const Crossing& c);

/// The caller's vertex at corner k of face f of the surface.
Index source_vertex(const TriangleMesh& surface, Index f, int k);
/// The caller's vertex at the caller's corner k of face f.
Index source_corner(const TriangleMesh& surface, Index f, int k);

/// How many vertices the caller's mesh has, unused ones included.
Index source_vertex_count(const TriangleMesh& surface);

struct ConnectOptions {
  /// Vertices at equal positions are joined where that closes boundary edges in pairs. Without it
  /// vertices are who they are by number: curves stop at seams.
  bool join = true;
};

/// What `connect` found and did; vertices, faces and edges are the caller's.
struct ConnectReport {
  VertexFinding unused_vertices;   ///< that no face names, left out
  FaceFinding repeated_corners;    ///< faces with two corners at one place, left out
  DuplicateFinding doubled_faces;  ///< faces where another lies, either way round, left out
  FaceFinding turned_faces;        ///< turned to the side of the faces around them, or outward
  VertexFinding joined_vertices;   ///< that were joined to one of a lower number
  EdgeFinding joined_edges;        ///< edges between faces that did not share both vertices
  VertexFinding split_vertices;    ///< where fans of faces met in a point: one vertex for each
  EdgeFinding split_edges;         ///< with three or more faces: paired, the rest opened
  EdgeFinding one_sided_edges;     ///< opened: no choice of sides is consistent (a Moebius strip)
  /// With `join` off: boundary edges that lie where another one ends or begins.
  EdgeFinding seam_edges;

  /// Something was wrong with the mesh, rather than only cut along seams or with vertices to spare.
  bool is_flawed() const {
    return repeated_corners.count > 0 || doubled_faces.count > 0 || turned_faces.count > 0 ||
           split_vertices.count > 0 || split_edges.count > 0 || one_sided_edges.count > 0;
  }
  /// What was done and where, a sentence each; empty where nothing was.
  std::vector<std::string> sentences() const;
};

struct Connected {
  TriangleMesh mesh;
  HalfEdges half_edges;  ///< of it
  ConnectReport report;
};

/// The surface that a mesh of any kind is meant to be: a mesh whose edges have one or two faces of
/// the same orientation and whose vertices have one fan each, so that every technique can walk on
/// it. Positions and face numbers are the caller's (polygon numbers, too); `mesh.source()` maps
/// vertices and corners where they are not. A mesh that is such a surface comes back as it is.
/// Attributes stay with the corners and faces that they are of, whatever becomes of the vertices.
///
/// - Vertices that no face uses are left out.
/// - A face with two corners at one place, and the faces of a polygon that lies where an earlier
/// one
///   does (same corners, either side), are left out: they keep their number, with all corners at
///   one vertex. Doubles that wall off a part from another (two closed boxes that touch) stay.
/// - Faces that run against their neighbours are turned: to the side that encloses a positive
///   volume where the part is closed, else to that of most faces; in a one-sided part where it
///   mends more edges than it leaves. A closed part whose faces all come from both sides encloses a
///   positive volume, too.
/// - Half-edges that share both vertices and run against each other are neighbours. The rest is
///   paired by position: vertices at equal positions (bit by bit, -0 taken for 0) are joined where
///   that closes boundary edges in pairs, and never so that an edge gets a third face.
/// - Of three or more faces at an edge the two of each part are neighbours, where a part comes with
///   two; of what is left the two of each solid, where the faces bound solids that touch there:
///   boxes that touch stay boxes. Elsewhere those are whose angles, measured through the surface's
///   back, differ least from straight (sum of squares): a fin on a sheet is opened. Edges of more
///   than 64 faces are opened.
/// - Where joined vertices would let two edges run between the same two vertices the join is undone
///   beside them (a sheet and its back meet at a rim).
/// - A vertex where several fans meet becomes one for each.
///
/// Never throws. O(n log n), n = #V + #F; for a sound mesh about the time of its HalfEdges and a
/// hash of the positions.
Connected connect(TriangleMesh mesh, const ConnectOptions& options = {});

/// The counts and findings of a mesh, with the measures, components and boundary of the surface
/// that was made of it (`validate` of that): what it is as one draws on it. Its `is_manifold` and
/// `is_closed` speak of the mesh, those of `surface` of the surface.
MeshReport report_as_drawn(const TriangleMesh& mesh, const MeshReport& surface);

}  // namespace mimicry
