#pragma once

#include <span>
#include <vector>

#include <mimicry/mesh/surface.h>

namespace mimicry {

struct KeypointOptions {
  double window = 0.05;         ///< that curvature is averaged over, a part of the curve's length
  double least_gap_m = 0.03;    ///< no two of the ends and extrema are nearer, along the curve,
  double least_gap_part = 0.1;  ///< nor nearer than this part of its length
  double longest_gap_m = 0.15;  ///< longer sections are divided evenly
};

/// The keypoints by which a target curve is shown when it is to be re-created (paper, appendix B):
/// numbers of points, increasing, the first and the last among them. Between them extrema of
/// geodesic curvature, strongest first: the curvature at a point is the size of the signed
/// deviations from a straightest geodesic within the window around it, summed, by the window's
/// length; extrema are its peaks above its mean. Then each section longer than longest_gap_m is
/// divided evenly. The points are joined by shortest paths. Empty for no points, one keypoint for a
/// single one. Throws Error(invalid_input) where the curve leaves the mesh, metres_per_unit is not
/// > 0, or an option is out of range. O(points) paths; about 2 ms for 500 points.
std::vector<Index> keypoints(const Surface& surface, std::span<const SurfacePoint> points,
                             double metres_per_unit, const KeypointOptions& options = {});

}  // namespace mimicry
