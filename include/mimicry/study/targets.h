#pragma once

#include <cstddef>
#include <numbers>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <mimicry/base/parallel.h>
#include <mimicry/base/random.h>
#include <mimicry/embedding/smooth_projector.h>
#include <mimicry/mesh/surface.h>
#include <mimicry/mesh/triangle_mesh.h>
#include <mimicry/spatial/target.h>
#include <mimicry/stroke/stroke.h>

namespace mimicry {

/// What a target curve was sampled with (paper, appendix B).
struct TargetParameters {
  Index control_points = 6;  ///< n
  double k_g = 0.0;          ///< geodesic distance between controls, in diagonals
  double k_n_deg = 0.0;      ///< angle between the normals of consecutive controls
};

/// An intended curve of a study task.
struct TargetCurve {
  std::vector<SurfacePoint> points;
  std::vector<Index> keypoints;  ///< numbers of points, increasing; empty where unpublished
  std::optional<TargetParameters> parameters;
};

struct TargetShape {
  std::string name;
  double scale = 1.0;  ///< metres per mesh unit at which the shape was shown
  std::vector<TargetCurve> curves;
};

struct TargetSet {
  std::vector<TargetShape> shapes;

  /// nullptr for an unknown name.
  const TargetShape* find(std::string_view name) const {
    for (const TargetShape& shape : shapes)
      if (shape.name == name) return &shape;
    return nullptr;
  }
};

/// Throws Error(invalid_input), naming shape, curve and point, where a point names a face that the
/// mesh has not, or where a curve steps over more than a quarter of the mesh's diagonal: the mesh
/// is another one, or its faces stand in another order. O(vertices and points).
void require_fits(const TargetShape& shape, const TriangleMesh& mesh);

/// Three or more curves that a person might mean to draw on a built-in shape: "closed", "winding",
/// and "across" (over sharp edges; on smooth shapes through the region of highest curvature). They
/// are laid out in the shape's own parameters and mapped to the closest points of `target`, the
/// shape at any resolution (noisy-cube, with any noise: the curves of the plain cube, moved with
/// its faces). Points about 0.5 % of the diagonal apart, in the order of drawing; a closed curve
/// ends in its first point. Throws Error(invalid_input) for an unknown shape, and for "noisy-cube"
/// where the target has not the faces of one. About 5 ms a curve.
std::vector<Intention> intended_curves(std::string_view shape, const Target& target);

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

/// Target curves <n, i_0, k_G, k_N> (paper, appendix B). The ranges are the paper's; i_0 is drawn
/// from all vertices, k_G and k_N evenly from their ranges.
struct TargetSampling {
  Index controls = 6;       ///< n, at least 4
  double least_k_g = 0.05;  ///< geodesic distance between controls, in diagonals
  double most_k_g = 0.25;
  double least_k_n_rad = std::numbers::pi / 6;  ///< angle between the controls' normals
  double most_k_n_rad = 5 * std::numbers::pi / 12;
  Index points = 501;       ///< of each curve, at even parameters; at least 2
  int most_attempts = 100;  ///< for one curve, before it is given up
};

/// Control points C_1 = first, C_i the vertex with the least
/// (d_G(C_{i-1}, v) - k_G)^2 + (d_N(C_{i-1}, v) - k_N)^2 among those farther than k_G / 2 from all
/// earlier ones: d_G the exact geodesic distance in diagonals, d_N the angle between vertex
/// normals; of equals the lowest number. Fewer than `count` where no vertex is left. count searches
/// from one vertex to all.
std::vector<Index> control_points(const Target& target, Index first, Index count, double k_g,
                                  double k_n_rad);

/// Attempts by what became of them.
struct SamplingCounts {
  std::size_t accepted = 0;
  std::size_t no_controls = 0;    ///< no vertex was left far enough from the others
  std::size_t jumps = 0;          ///< the spline is not continuous on the surface
  std::size_t self_crossing = 0;  ///< the curve meets itself
};

struct SampledTargets {
  std::vector<TargetCurve> curves;  ///< with parameters and keypoints
  SamplingCounts counts;
};

/// `count` target curves: cubic B-splines on the surface, with clamped ends, that start and
/// end in their first and last control. Refused and drawn anew are splines with a step on the
/// surface longer than a twentieth of their length or none at all, and curves that meet themselves
/// (`self_crossing`). metres_per_unit is for the keypoints. Throws Error(invalid_input) for
/// options out of range and where most_attempts do not give a curve, Error(cancelled). Equal
/// arguments give equal curves.
SampledTargets sample_targets(const SmoothProjector& projector, double metres_per_unit,
                              std::size_t count, const TargetSampling& options, Random random,
                              const ProgressCallback& progress = {});

}  // namespace mimicry
