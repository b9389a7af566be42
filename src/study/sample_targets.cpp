#include <algorithm>
#include <cmath>
#include <optional>

#include <mimicry/base/error.h>
#include <mimicry/geodesic/exact.h>
#include <mimicry/study/targets.h>

#include "curve/curve_builder.h"
#include "curve/self_crossing.h"
#include "embedding/spline.h"
#include "geodesic/site.h"

namespace mimicry {
namespace {

constexpr double kLongestStep = 1.0 / 20.0;  // parts of the curve's length

void require_sound(const TargetSampling& options) {
  const auto refuse = [](const char* what) {
    throw Error(ErrorKind::invalid_input, std::string("target curves: ") + what);
  };
  if (options.controls < 4) refuse("a spline needs at least 4 control points");
  if (!(options.least_k_g > 0.0 && options.least_k_g <= options.most_k_g &&
        options.most_k_g <= 10.0))
    refuse("the range of k_G is not within (0, 10]");
  if (!(options.least_k_n_rad >= 0.0 && options.least_k_n_rad <= options.most_k_n_rad &&
        options.most_k_n_rad <= std::numbers::pi))
    refuse("the range of k_N is not within 0 to 180 degrees");
  if (options.points < 2) refuse("a curve needs at least 2 points");
  if (options.most_attempts < 1) refuse("the number of attempts is below 1");
}

ProjectedCurve joined_points(const Target& target, const std::vector<SmoothPoint>& points) {
  CurveBuilder builder(target.surface());
  for (const SmoothPoint& p : points)
    builder.append({p.surface, p.position, Vec3::Zero(), kNone, 0.0, 0.0});
  return builder.curve();
}

bool is_continuous(const ProjectedCurve& curve) {
  const double longest = kLongestStep * length(curve);
  return longest > 0.0 &&
         std::all_of(curve.pieces.begin(), curve.pieces.end(), [&](const Piece& piece) {
           return piece.kind != PieceKind::chord && piece.length <= longest;
         });
}

std::optional<TargetCurve> attempt(const SmoothProjector& projector, double metres_per_unit,
                                   const TargetSampling& options, Random& random,
                                   SamplingCounts& counts) {
  const Target& target = projector.target();
  const auto first =
      static_cast<Index>(random.below(static_cast<std::uint32_t>(target.mesh().vertex_count())));
  const double k_g = random.uniform(options.least_k_g, options.most_k_g);
  const double k_n = random.uniform(options.least_k_n_rad, options.most_k_n_rad);
  const std::vector<Index> vertices = control_points(target, first, options.controls, k_g, k_n);
  if (static_cast<Index>(vertices.size()) < options.controls) {
    ++counts.no_controls;
    return std::nullopt;
  }
  std::vector<SurfacePoint> controls;
  for (const Index v : vertices) controls.push_back(vertex_point(target.half_edges(), v));
  const auto points = clamped_b_spline_curve(projector, controls, options.points);
  const ProjectedCurve curve = joined_points(target, points);
  if (!is_continuous(curve)) {
    ++counts.jumps;
    return std::nullopt;
  }
  if (self_crossing(refine(curve, target.surface()), target.mesh())) {
    ++counts.self_crossing;
    return std::nullopt;
  }
  ++counts.accepted;
  TargetCurve result;
  for (const SmoothPoint& p : points) result.points.push_back(p.surface);
  result.keypoints = keypoints(target.surface(), result.points, metres_per_unit);
  result.parameters = {options.controls, k_g, k_n * 180.0 / std::numbers::pi};
  return result;
}

}  // namespace

std::vector<Index> control_points(const Target& target, Index first, Index count, double k_g,
                                  double k_n_rad) {
  const TriangleMesh& mesh = target.mesh();
  const auto vertices = static_cast<std::size_t>(mesh.vertex_count());
  ExactGeodesics distances(target.surface());
  std::vector<double> nearest(vertices, kInfinity);  // to the controls so far, in diagonals
  std::vector<Index> controls;
  if (vertex_point(target.half_edges(), first).face == kNone) return controls;
  controls.push_back(first);
  while (static_cast<Index>(controls.size()) < count) {
    const Index last = controls.back();
    const Vec3& normal = target.vertex_normals()[static_cast<std::size_t>(last)];
    distances.compute(vertex_point(target.half_edges(), last));
    Index best = kNone;
    double least = kInfinity;
    for (std::size_t v = 0; v < vertices; ++v) {
      const double d = distances.distance(static_cast<Index>(v)) / target.diagonal();
      nearest[v] = std::min(nearest[v], d);
      if (std::isinf(d) || nearest[v] < 0.5 * k_g) continue;
      const Vec3& other = target.vertex_normals()[v];
      const double angle = std::atan2(normal.cross(other).norm(), normal.dot(other));
      const double off = (d - k_g) * (d - k_g) + (angle - k_n_rad) * (angle - k_n_rad);
      if (off < least) best = static_cast<Index>(v), least = off;
    }
    if (best == kNone) break;
    controls.push_back(best);
  }
  return controls;
}

SampledTargets sample_targets(const SmoothProjector& projector, double metres_per_unit,
                              std::size_t count, const TargetSampling& options, Random random,
                              const ProgressCallback& progress) {
  require_sound(options);
  SampledTargets result;
  while (result.curves.size() < count) {
    std::optional<TargetCurve> curve;
    for (int tries = 0; !curve; ++tries) {
      report(progress, "curves",
             static_cast<double>(result.curves.size()) / static_cast<double>(count));
      if (tries == options.most_attempts)
        throw Error(ErrorKind::invalid_input,
                    "target curves: " + std::to_string(tries) +
                        " attempts gave no curve (of all so far " +
                        std::to_string(result.counts.self_crossing) + " met themselves, " +
                        std::to_string(result.counts.jumps) + " jumped, " +
                        std::to_string(result.counts.no_controls) +
                        " found no room for their controls); take fewer controls or smaller k_G");
      curve = attempt(projector, metres_per_unit, options, random, result.counts);
    }
    result.curves.push_back(std::move(*curve));
  }
  return result;
}

}  // namespace mimicry
