#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include <mimicry/base/error.h>
#include <mimicry/curve/projected_curve.h>
#include <mimicry/study/measures.h>

#include "curve/curve_builder.h"
#include "study/polyline.h"

namespace mimicry {
namespace {

void require_measurable(const ProjectedCurve& curve, std::span<const MotionSample> motion) {
  if (curve.points.empty())
    throw Error(ErrorKind::invalid_input, "the curve is empty: nothing was drawn");
  if (motion.empty()) throw Error(ErrorKind::invalid_input, "the stroke has no frames");
  for (std::size_t i = 0; i < motion.size(); ++i) {
    if (!std::isfinite(motion[i].time_s))
      throw Error(ErrorKind::invalid_input,
                  "the time of frame " + std::to_string(i) + " is not a number");
    if (i > 0 && motion[i].time_s < motion[i - 1].time_s)
      throw Error(ErrorKind::invalid_input, "time runs backwards at frame " + std::to_string(i));
  }
}

bool has_gap(const ProjectedCurve& curve) {
  return std::any_of(curve.pieces.begin(), curve.pieces.end(),
                     [](const Piece& piece) { return piece.kind == PieceKind::gap; });
}

// Sum of |change of the deviation| between neighbouring nodes at which it is defined.
double total_change(const CurveCurvature& curvature) {
  double sum = 0.0;
  bool follows = false;
  double last = 0.0;
  for (std::size_t i = 0; i < curvature.uses.size(); ++i) {
    if (curvature.uses[i] == NodeUse::end) follows = false;
    if (curvature.uses[i] != NodeUse::measured) continue;
    if (follows) sum += std::abs(curvature.deviation[i] - last);
    follows = true;
    last = curvature.deviation[i];
  }
  return sum;
}

void measure_curvature(const ProjectedCurve& curve, const Surface& surface, double length_m,
                       Measures& m) {
  const CurveCurvature bends = curvature(refine(curve, surface), surface);
  m.k_e_rad_per_m = bends.total_turning / length_m;
  m.k_g_rad_per_m = bends.total_absolute_deviation / length_m;
  m.k_g_normalised_rad_per_m = bends.total_absolute_normalised / length_m;
  m.f_g_rad_per_m = total_change(bends) / length_m;
  m.boundary_nodes = bends.boundary_nodes;
  m.undefined_nodes = bends.undefined_nodes;
}

void measure_jumps(const ProjectedCurve& curve, std::span<const Vec3> drawn,
                   std::span<const MotionSample> motion, Measures& m) {
  const auto is_known = [&](Index frame) {
    return frame >= 0 && static_cast<std::size_t>(frame) < motion.size();
  };
  std::size_t steps = 0;
  std::size_t jumping = 0;
  for (std::size_t i = 0; i < curve.pieces.size(); ++i) {
    if (curve.pieces[i].kind == PieceKind::gap) {
      ++m.gaps;
      continue;
    }
    const Index from = curve.points[i].frame;
    const Index to = curve.points[i + 1].frame;
    if (!is_known(from) || !is_known(to)) continue;
    const double hand =
        (motion[static_cast<std::size_t>(to)].pen - motion[static_cast<std::size_t>(from)].pen)
            .norm();
    if (hand < kLeastStep_m) continue;
    const double jump = (drawn[i + 1] - drawn[i]).norm() / hand;
    ++steps;
    jumping += jump > kJumpRatio ? 1 : 0;
    m.largest_jump = std::max(m.largest_jump, jump);
  }
  if (steps > 0) m.share_jumping = static_cast<double>(jumping) / static_cast<double>(steps);
}

}  // namespace

IntendedCurve intended_curve(const TriangleMesh& mesh, const TargetCurve& curve,
                             double metres_per_unit) {
  std::vector<Vec3> points;
  points.reserve(curve.points.size());
  for (const SurfacePoint& p : curve.points) {
    if (p.face < 0 || p.face >= mesh.face_count())
      throw Error(ErrorKind::invalid_input,
                  "the target curve names face " + std::to_string(p.face) + ", but the mesh has " +
                      std::to_string(mesh.vertex_count()) + " vertices and " +
                      std::to_string(mesh.face_count()) +
                      " faces; it is not the mesh that the curve was made on");
    points.push_back(metres_per_unit * mesh.position(p));
  }
  IntendedCurve intended;
  intended.metres_per_unit = metres_per_unit;
  intended.length_m = polyline_length(points);
  if (!(intended.length_m > 0.0) || !std::isfinite(intended.length_m))
    throw Error(ErrorKind::invalid_input, "the target curve has no length");
  intended.compared = resample(points, kComparedPoints);
  for (const Index keypoint : curve.keypoints) {
    if (keypoint < 0 || static_cast<std::size_t>(keypoint) >= points.size())
      throw Error(ErrorKind::invalid_input, "keypoint " + std::to_string(keypoint) +
                                                " lies beyond the target curve's points");
    intended.keypoints.push_back(points[static_cast<std::size_t>(keypoint)]);
  }
  return intended;
}

ProjectedCurve joined(const ProjectedCurve& curve, const Surface& surface) {
  if (!has_gap(curve)) return curve;
  CurveBuilder builder(surface);
  builder.reserve(curve.points.size());
  for (const CurvePoint& point : curve.points) builder.append(point);
  ProjectedCurve result = builder.curve();
  result.closed = curve.closed;
  return result;
}

Measures measure(const Surface& surface, const IntendedCurve& intended, const ProjectedCurve& curve,
                 std::span<const MotionSample> motion, const MeasureOptions& options) {
  const TriangleMesh& mesh = surface.mesh();
  require_measurable(curve, motion);
  Measures m;
  m.l_x_m = intended.length_m;

  std::vector<Vec3> drawn;
  drawn.reserve(curve.points.size());
  for (const CurvePoint& p : curve.points)
    drawn.push_back(intended.metres_per_unit * mesh.position(p.surface));
  const double length_m = polyline_length(drawn);
  const std::vector<Vec3> q = resample(drawn, kComparedPoints);
  m.d_ep_m = mean_distance(q, intended.compared);
  m.d_sym_m = symmetric_distance(q, intended.compared);
  m.frechet_m = frechet_distance(q, intended.compared);
  m.end_lag_m = (drawn.back() - intended.compared.back()).norm();
  m.length_ratio = length_m / m.l_x_m;

  if (options.join_pieces && has_gap(curve))
    measure_curvature(joined(curve, surface), surface, m.l_x_m, m);
  else
    measure_curvature(curve, surface, m.l_x_m, m);
  measure_jumps(curve, drawn, motion, m);

  const MotionLengths moved = motion_lengths(filtered(motion));
  m.t_h = moved.head_m / m.l_x_m;
  m.r_h_rad_per_m = moved.head_rad / m.l_x_m;
  m.t_c = moved.pen_m / m.l_x_m;
  m.r_c_rad_per_m = moved.pen_rad / m.l_x_m;
  m.tau_s = motion.back().time_s - motion.front().time_s;

  std::vector<Vec3> pen;
  pen.reserve(motion.size());
  for (const MotionSample& sample : motion) pen.push_back(sample.pen);
  m.mimicry_violation =
      distance_spread(resample(pen, kComparedPoints), intended.compared) / m.l_x_m;

  m.filters.too_short = length_m < 0.5 * m.l_x_m;
  for (std::size_t i = 1; i < pen.size(); ++i)
    m.filters.noisy = m.filters.noisy || (pen[i] - pen[i - 1]).norm() > kNoisyStep_m;
  const std::size_t keypoints = intended.keypoints.size();
  m.filters.inverted =
      keypoints > 1 && 4 * inversions(drawn, intended.keypoints) > keypoints * (keypoints - 1);
  return m;
}

}  // namespace mimicry
