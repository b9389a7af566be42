#pragma once

#include <vector>

#include <mimicry/mesh/crossing.h>
#include <mimicry/mesh/half_edges.h>
#include <mimicry/mesh/triangle_mesh.h>

namespace mimicry::geodesic {

struct PlaneSectionOptions {
  /// The walk is given up when it is longer than this many times the distance between the points.
  double longest_ratio = 8.0;
};

struct PlaneSection {
  bool found = false;
  double length = 0.0;  ///< along the section, model units
};

/// Joins two surface points by the section of the mesh with the plane through both whose direction
/// contains `normal` (say the mean of the surface's normals at both). Appends the edge crossings in
/// order from `from` to `to`, exclusive of the ends, to `crossings`; of the two ways around the
/// section the shorter one that arrives. A section that meets a boundary, leaves for too long or
/// does not reach `to` appends nothing and has found == false; so do points whose plane is
/// undefined (equal points in different components, or a normal along their difference). Vertices
/// that lie on the plane count as on its positive side, so that a section is never ambiguous. Cost:
/// linear in the faces crossed; no allocation beyond the growth of `crossings`.
PlaneSection trace_plane_section(const TriangleMesh& mesh, const HalfEdges& half_edges,
                                 const SurfacePoint& from, const SurfacePoint& to,
                                 const Vec3& normal, std::vector<Crossing>& crossings,
                                 const PlaneSectionOptions& options = {});

}  // namespace mimicry::geodesic
