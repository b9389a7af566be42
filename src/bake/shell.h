#pragma once

#include <vector>

#include <mimicry/base/parallel.h>
#include <mimicry/mesh/triangle_mesh.h>

#include "bake/ls_mesh.h"

namespace mimicry {

struct ShellOptions {
  double offset = 0.05;   ///< half the shell's thickness, as a fraction of the diagonal
  int most_rounds = 100;  ///< of splitting edges and faces
};

/// Tetrahedra that cover everything within `offset` of a surface.
struct Shell {
  std::vector<Vec3> positions;  ///< the surface's vertices first
  std::vector<Tet> tets;        ///< positively oriented
  std::vector<Tie> ties;        ///< added vertices on the surface, tied to its vertices
  Index overlapping_tets = 0;   ///< the last so many may stand where others of them stand
  std::vector<Index> copy_of;   ///< the last vertices stand where these stand
  /// Of the lattice: where each vertex of the surface (`row`) stands in the tetrahedra.
  std::vector<SoftConstraint> bindings;

  bool is_lattice = false;
  int rounds = 0;
  Index added_vertices = 0;  ///< on edges and faces of the surface
  Index missing_edges = 0;   ///< pieces of edges that are not edges of the tetrahedra
  Index pierced_faces = 0;   ///< faces that an edge of the tetrahedra still crosses
  /// Faces that edges of the surface cross: it meets itself. Not all of them where they are many.
  Index crossing_faces = 0;
  bool hit_a_cap = false;  ///< rounds, shortest edge or count
};

/// A shell in which the faces of the surface stand as faces of tetrahedra: Delaunay tetrahedra of
/// the surface's vertices and an octree's nodes around them, then edges that are missing are split
/// at their midpoints, and faces that are pierced get the piercing point, until all are there or a
/// cap is hit; what is missing then is counted. Where that is more than 1 % of the edges or faces
/// there are no tetrahedra, nor where they would be more than 400,000 and 15 a face. Nodes are as
/// close together as the surface's vertices unless that is more than 40,000 and 3 a face (more in a
/// thinner shell). mesh: centred, with a diagonal of 1, no two vertices at one place, some face
/// with area. O(n log n), about 10 microseconds a tetrahedron's vertex.
Shell make_shell(const TriangleMesh& mesh, const ShellOptions& options, Executor& executor,
                 const ProgressCallback& progress = {});

/// A cubic lattice with a step of at most a quarter of the offset (or half of it, or all, where
/// that is too many cells), 6 tetrahedra a cell, for surfaces that defy the other: any triangles
/// whatever.
Shell make_lattice_shell(const TriangleMesh& mesh, const ShellOptions& options, Executor& executor,
                         const ProgressCallback& progress = {});

/// make_shell, or the lattice where more than 1 % of the edges or faces stay missing, or where
/// edges of the surface cross its faces more than 100 times and once for every second face.
Shell make_some_shell(const TriangleMesh& mesh, const ShellOptions& options, Executor& executor,
                      const ProgressCallback& progress = {});

}  // namespace mimicry
