#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <mimicry/mesh/half_edges.h>
#include <mimicry/mesh/surface.h>

namespace mimicry {

enum class PathLabel : std::uint8_t {
  same_face,         ///< both points lie in one face: straight, no crossings
  shortest,          ///< proven to be the shortest on the whole mesh
  locally_shortest,  ///< straight everywhere, but the search for a shorter one was given up
  disconnected       ///< no path joins the points: another component
};

struct LocalPathOptions {
  /// Work after which the exact search gives up; about 0.2 microseconds each.
  std::size_t most_windows = 4096;
};

struct LocalPath {
  PathLabel label = PathLabel::disconnected;
  double length = kInfinity;  ///< model units
  std::size_t windows = 0;    ///< work done
};

/// Shortest paths between nearby points, in real time and without any preparation of the mesh: it
/// may deform between calls. The exact search unfolds faces from the first point and always goes on
/// where the way so far and the straight line through space to the second point are shortest
/// together, so that it sees little more than the path's own faces. Every way that is left is
/// longer than the one found when it stops: the proof of "shortest". When it gives up, a path along
/// edges is straightened around its vertices (Xin and Wang 2007; the moves are those of Sharp and
/// Crane 2020 on the faces crossed).
/// Boundary and non-manifold edges are not crossed, and a vertex where several fans touch is not
/// passed from one fan into another. Holds scratch of #V, and of #F once a search has given up;
/// other calls do not allocate.
class LocalPathFinder {
 public:
  explicit LocalPathFinder(const Surface& surface);
  ~LocalPathFinder();
  LocalPathFinder(LocalPathFinder&&) noexcept;
  LocalPathFinder& operator=(LocalPathFinder&&) noexcept;

  /// Appends the crossings from `from` to `to`, exclusive of the ends, to `crossings`. Throws
  /// Error(invalid_input) for points off the mesh.
  LocalPath find(const SurfacePoint& from, const SurfacePoint& to, std::vector<Crossing>& crossings,
                 const LocalPathOptions& options = {});

 private:
  struct State;
  std::unique_ptr<State> state_;
};

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

struct BezierCurve {
  /// False where no path joins two neighbouring control points; there are no points then.
  bool connected = true;
  bool all_shortest = true;          ///< no search for a shortest path was given up
  std::vector<SurfacePoint> points;  ///< at even steps of the parameter
};

/// A Bezier curve on the surface with its degree one below the number of control points: de
/// Casteljau's algorithm with geodesics for straight lines (Park and Ravani 1995), `count` points
/// with the parameters i / (count - 1). It starts in the first control point and ends in the last.
/// Where a geodesic between two of its points jumps from one side of an obstacle to the other as
/// the parameter grows, so does the curve: keep the control points close against the size of
/// handles and bumps. Throws Error(invalid_input) for no control point, points off the mesh or a
/// count below 2. O(count * controls^2) paths.
BezierCurve bezier(const Surface& surface, std::span<const SurfacePoint> controls,
                   std::size_t count, const LocalPathOptions& options = {});

}  // namespace mimicry
