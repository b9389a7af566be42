#include <mimicry/study/measures.h>
#include <mimicry/study/targets.h>

#include "capi/handles.h"

using namespace mimicry;
using namespace mimicry::capi;

mimicry_status mimicry_keypoints(const mimicry_target* target, const mimicry_surface_point* points,
                                 size_t count, double metres_per_unit, int32_t* numbers,
                                 size_t* found) {
  return guarded([&] {
    require(target, "target");
    require(found, "found");
    if (count > 0) require(numbers, "numbers");
    require_positive(metres_per_unit, "metres_per_unit");
    const Target& t = *target->target;
    const std::vector<Index> keypoints =
        mimicry::keypoints(t.surface(), to_points(t, points, count, "point"), metres_per_unit);
    std::copy(keypoints.begin(), keypoints.end(), numbers);
    *found = keypoints.size();
  });
}

namespace {

mimicry_measures from_measures(const Measures& m) {
  mimicry_measures out{};
  out.d_ep_m = m.d_ep_m;
  out.d_sym_m = m.d_sym_m;
  out.k_e_rad_per_m = m.k_e_rad_per_m;
  out.k_g_rad_per_m = m.k_g_rad_per_m;
  out.f_g_rad_per_m = m.f_g_rad_per_m;
  out.t_h = m.t_h;
  out.r_h_rad_per_m = m.r_h_rad_per_m;
  out.t_c = m.t_c;
  out.r_c_rad_per_m = m.r_c_rad_per_m;
  out.tau_s = m.tau_s;
  out.mimicry_violation = m.mimicry_violation;
  out.l_x_m = m.l_x_m;
  out.k_g_normalised_rad_per_m = m.k_g_normalised_rad_per_m;
  out.largest_jump = m.largest_jump;
  out.share_jumping = m.share_jumping;
  out.frechet_m = m.frechet_m;
  out.end_lag_m = m.end_lag_m;
  out.length_ratio = m.length_ratio;
  out.gaps = static_cast<int32_t>(m.gaps);
  out.boundary_nodes = static_cast<int32_t>(m.boundary_nodes);
  out.undefined_nodes = static_cast<int32_t>(m.undefined_nodes);
  out.too_short = m.filters.too_short;
  out.noisy = m.filters.noisy;
  out.inverted = m.filters.inverted;
  return out;
}

}  // namespace

mimicry_status mimicry_measure(const mimicry_curve* curve, const mimicry_similarity* model_to_world,
                               const mimicry_frame* frames, size_t frame_count,
                               const mimicry_surface_point* intended, size_t intended_count,
                               const int32_t* keypoints, size_t keypoint_count, int32_t join_pieces,
                               mimicry_measures* out) {
  return guarded([&] {
    require(curve, "curve");
    require(out, "out");
    if (keypoint_count > 0) require(keypoints, "keypoints");
    const Target& target = *curve->target;
    const Stroke stroke = to_stroke(model_to_world, frames, frame_count);
    TargetCurve x;
    x.points = to_points(target, intended, intended_count, "intended point");
    x.keypoints.assign(keypoints, keypoints + keypoint_count);
    const IntendedCurve compared = intended_curve(target.mesh(), x, stroke.model_to_world.scale);
    *out = from_measures(measure(target.surface(), compared, curve->record.curve, motion_of(stroke),
                                 {join_pieces != 0}));
  });
}
