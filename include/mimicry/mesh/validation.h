#pragma once

#include <optional>
#include <vector>

#include <mimicry/mesh/triangle_mesh.h>

namespace mimicry {

/// How many there are, and the one with the lowest number; kNone where there is none.
struct VertexFinding {
  Index count = 0;
  Index first = kNone;
};

struct FaceFinding {
  Index count = 0;
  Index first = kNone;
};

/// The first edge is the one with the lowest half-edge number, given by its vertices.
struct EdgeFinding {
  Index count = 0;
  Index first_tail = kNone;
  Index first_head = kNone;
};

struct BoundaryFinding {
  Index loops = 0;
  EdgeFinding edges;
};

struct DuplicateFinding {
  Index count = 0;      ///< faces beyond the first of each set
  Index first = kNone;  ///< the first face that repeats another
  Index first_copy_of = kNone;
};

/// Faces that share vertices, directly or through others.
struct ComponentReport {
  Index first_face = kNone;
  Index vertices = 0;
  Index edges = 0;
  Index faces = 0;
  Index boundary_loops = 0;
  Index euler = 0;          ///< vertices - edges + faces
  bool manifold = false;    ///< no edge with 3 or more faces, no non-manifold vertex
  bool closed = false;      ///< manifold, without boundary
  bool orientable = false;  ///< some choice of directions is consistent (the stored one may not be)
  /// (2 - boundary_loops - euler) / 2; where the component is manifold and orientable.
  std::optional<Index> genus;
};

/// What a mesh is and what is odd about it. Everything that speaks of edges, fans, boundaries or
/// components leaves out the faces that name a vertex twice.
struct MeshReport {
  Index vertices = 0;
  Index faces = 0;
  Index edges = 0;
  /// (Vertices with faces) - edges + faces.
  Index euler = 0;

  /// Used by a face and not finite, or with a coordinate beyond 1e100 (areas and volumes would
  /// overflow). Faces at such vertices are left out of all measures below.
  VertexFinding invalid_vertices;
  VertexFinding isolated_vertices;  ///< that no face names
  /// Edges with three or more faces.
  EdgeFinding nonmanifold_edges;
  /// The faces around it, stepping over shared edges, fall into several fans.
  VertexFinding nonmanifold_vertices;
  /// Edges with two faces that run along it in the same direction.
  EdgeFinding inconsistent_edges;
  BoundaryFinding boundary;
  FaceFinding repeated_corners;  ///< faces that name a vertex twice
  /// Faces without area: smallest height <= 1e-10 of the longest edge, or longest edge <= 1e-12 of
  /// the diagonal. Includes those of `repeated_corners`.
  FaceFinding degenerate_faces;
  DuplicateFinding duplicate_faces;  ///< same three vertices in any order

  std::vector<ComponentReport> components;  ///< by their first face
  /// Sum over the components; where all of them have one.
  std::optional<Index> genus;

  Eigen::AlignedBox3d box;  ///< of all valid vertices that faces use; empty without one
  double diagonal = 0;
  double area = 0;
  /// Enclosed, positive where faces run counter-clockwise seen from outside; where the mesh is
  /// closed, manifold and consistently oriented and all vertices are valid.
  std::optional<double> volume;
  double shortest_edge = 0;
  double mean_edge = 0;
  double longest_edge = 0;

  /// The same as HalfEdges::is_manifold().
  bool is_manifold() const {
    return nonmanifold_edges.count == 0 && nonmanifold_vertices.count == 0 &&
           inconsistent_edges.count == 0;
  }
  /// Manifold with at least one face and no boundary.
  bool is_closed() const { return is_manifold() && edges > 0 && boundary.edges.count == 0; }
};

/// Looks at any mesh, however broken; never throws. O(n log n), n = #V + #F.
MeshReport validate(const TriangleMesh& mesh);

}  // namespace mimicry
