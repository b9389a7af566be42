#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <mimicry/mesh/crossing.h>
#include <mimicry/mesh/surface.h>

namespace mimicry {

enum class TraceStop : std::uint8_t {
  complete,      ///< the whole length was walked: `length` is what was asked for
  boundary,      ///< met a boundary edge or vertex, or left through it at once
  non_manifold,  ///< met a vertex where several fans touch
  no_direction,  ///< the direction has no part along the surface; nor has a face of fewer corners
  held_up        ///< went round in faces without size, or crossed too many
};

struct Trace {
  TraceStop stop = TraceStop::complete;
  SurfacePoint end;               ///< where it stopped
  Vec3 direction = Vec3::Zero();  ///< unit, in the plane of end.face: the way it was going
  double length = 0.0;            ///< walked, model units
};

/// The straightest geodesic from a surface point: straight in faces and over unfolded edges, and
/// with equal angles to its left and right at vertices (Polthier and Schmies 1998, definition 7).
/// This is the exponential map of direction times length. `direction` is a vector in space, any
/// length; its part in the plane of from.face counts when it leads into that face, else that of the
/// face around the point (of an edge or vertex) that it leads into best. length >= 0; 0 stays in
/// place. Appends the edges and vertices passed to `crossings` where it is given. Edges without
/// twin stop it, and so do faces without size in which it goes round, and 100,000 crossings and 300
/// for each face. Throws Error(invalid_input) for a point off the mesh and a direction or length
/// that is not finite or negative. O(faces crossed).
Trace trace_straightest(const Surface& surface, const SurfacePoint& from, const Vec3& direction,
                        double length, std::vector<Crossing>* crossings = nullptr);

/// Carries a tangent vector along a path on the surface: turned with the faces over edges; at a
/// vertex its angle to the path stays, angles there measured in parts of the vertex's total angle
/// (Polthier and Schmies 1998, definition 12). `vector` lies in the plane of from.face (what sticks
/// out of it is dropped), the answer in that of to.face; lengths stay. Through boundary and
/// non-manifold vertices it goes along the fan between the two faces. The path must be connected
/// (`Crossing`s as all path functions of this module give them). O(crossings + faces around the
/// vertices passed).
Vec3 parallel_transport(const Surface& surface, const SurfacePoint& from,
                        std::span<const Crossing> crossings, const SurfacePoint& to,
                        const Vec3& vector);

}  // namespace mimicry
