#pragma once

#include <cstddef>
#include <span>

#include <mimicry/base/parallel.h>
#include <mimicry/curve/projected_curve.h>
#include <mimicry/geodesic/paths.h>
#include <mimicry/mesh/surface.h>

namespace mimicry {

struct Closing {
  bool closed = false;                        ///< the curve is closed now
  PathLabel label = PathLabel::disconnected;  ///< of the joining piece
};

/// Closes a curve: joins its last point to its first by the shortest path on the surface. The first
/// point is appended, with frame and time of the last; where the last is the same point already,
/// only `closed` is set. Leaves a curve unchanged that is closed, has fewer than two points, or
/// whose ends the surface does not join (label `disconnected`). O(#V) and the path.
Closing close(ProjectedCurve& curve, const Surface& surface);

struct SmoothOptions {
  double strength = 0.5;  ///< 0 to 1: how far a point moves; 0 changes nothing
  int iterations = 1;     ///< 0 to kMostIterations
  static constexpr int kMostIterations = 100'000;
};

/// The curve with its points evened out, on the surface. In each iteration all points move at once,
/// along the geodesic toward the point that divides the geodesic between their neighbours as the
/// lengths of their two pieces; strength 1 goes half the way, which takes out a zigzag at once
/// (farther would mirror it), 0 none. A curve that is a geodesic stays. Ends of the curve and at
/// gaps and chords stay; a closed curve has none. Points keep frame, time and pen distance;
/// their normals are the surface's. Throws Error(invalid_input) for options
/// out of range. Three paths a point and iteration. progress hears of every few points, stage
/// "smooth"; where it returns false Error(cancelled) is thrown.
ProjectedCurve smooth(const ProjectedCurve& curve, const Surface& surface,
                      const SmoothOptions& options, const ProgressCallback& progress = {});

/// The curve with fewer points (Douglas and Peucker 1973, on geodesics): a point goes where it, and
/// all others that go with it, lie within `tolerance` (model units, in space) of the geodesic that
/// takes their place. Ends of the curve and at gaps and chords stay. Throws Error(invalid_input)
/// for a tolerance below 0 or not finite. O(points log points) paths as a rule, and at worst the
/// square of the points. progress as in `smooth`, stage "simplify".
ProjectedCurve simplify(const ProjectedCurve& curve, const Surface& surface, double tolerance,
                        const ProgressCallback& progress = {});

/// The open curve of points [first, end), with all that joins them. Throws Error(invalid_input)
/// where that is not a range of at least one point. O(its points and crossings).
ProjectedCurve slice(const ProjectedCurve& curve, std::size_t first, std::size_t end);

/// More points than this are a mistake: a gigabyte and more.
inline constexpr std::size_t kMostResampledPoints = 10'000'000;

/// The curve as `count` points, 2 to kMostResampledPoints, at equal steps of length (`resample`),
/// joined by shortest paths; broken where a gap lies between two of them. Times and pen distances
/// are interpolated, a point's frame is that of the last point before it, its normal the surface's.
/// Throws Error(invalid_input) for a count out of range or a curve without points. O(points +
/// crossings) and a path a point. progress as in `smooth`, stage "resample".
ProjectedCurve resampled(const ProjectedCurve& curve, const Surface& surface, std::size_t count,
                         const ProgressCallback& progress = {});

}  // namespace mimicry
