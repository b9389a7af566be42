#pragma once

#include <vector>

#include <mimicry/base/types.h>
#include <mimicry/mesh/crossing.h>
#include <mimicry/mesh/triangle_mesh.h>

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

}  // namespace mimicry
