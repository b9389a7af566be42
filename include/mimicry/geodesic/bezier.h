#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <mimicry/geodesic/local_path.h>
#include <mimicry/mesh/surface.h>

namespace mimicry {

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
