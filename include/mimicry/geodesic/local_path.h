#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include <mimicry/mesh/crossing.h>
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

}  // namespace mimicry
