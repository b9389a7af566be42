#include <mimicry/io/study.h>
#include <mimicry/study/targets.h>

#include "capi/handles.h"

using namespace mimicry;
using namespace mimicry::capi;

struct mimicry_target_curves {
  TargetShape shape;
};

namespace {

const TargetCurve* curve_at(const mimicry_target_curves* curves, size_t number) {
  return curves && number < curves->shape.curves.size() ? &curves->shape.curves[number] : nullptr;
}

}  // namespace

mimicry_sampling_options mimicry_default_sampling_options(void) {
  const TargetSampling d;
  return {d.least_k_g, d.most_k_g, d.least_k_n_rad, d.most_k_n_rad,
          d.controls,  d.points,   d.most_attempts, 0};
}

mimicry_status mimicry_target_curves_sample(const mimicry_target* target, size_t count,
                                            uint32_t seed, double metres_per_unit,
                                            const mimicry_sampling_options* options,
                                            mimicry_progress progress, void* user,
                                            mimicry_target_curves** out) {
  return made(out, [&] {
    require(target, "target");
    if (!target->projector)
      throw Error(ErrorKind::invalid_input,
                  "sampling curves needs the target's bake; bake it (mimicry_bake) or load its "
                  ".mimicry file (mimicry_target_with_embedding)");
    if (count < 1 || count > 1000)
      throw Error(ErrorKind::invalid_input,
                  std::to_string(count) + " curves; 1 to 1000 are possible");
    require_positive(metres_per_unit, "metres_per_unit");
    const mimicry_sampling_options o = options ? *options : mimicry_default_sampling_options();
    TargetSampling sampling;
    sampling.controls = o.controls;
    sampling.least_k_g = o.least_k_g;
    sampling.most_k_g = o.most_k_g;
    sampling.least_k_n_rad = o.least_k_n_rad;
    sampling.most_k_n_rad = o.most_k_n_rad;
    sampling.points = o.points;
    sampling.most_attempts = o.most_attempts;
    TargetShape shape;
    shape.name = target->view->name;
    shape.scale = metres_per_unit;
    shape.curves = sample_targets(*target->projector, metres_per_unit, count, sampling,
                                  Random(seed), to_callback(progress, user))
                       .curves;
    return mimicry_target_curves{std::move(shape)};
  });
}

mimicry_status mimicry_target_curves_read(const void* data, size_t size, const char* name,
                                          const char* shape, mimicry_target_curves** out) {
  return made(out, [&] {
    const std::string_view file = text(name, "name");
    TargetSet set = read_targets(content(data, size), file);
    if (!shape) {
      if (set.shapes.size() != 1)
        throw Error(ErrorKind::invalid_input, std::string(file) + ": has curves of " +
                                                  std::to_string(set.shapes.size()) +
                                                  " shapes; name one of them");
      return mimicry_target_curves{std::move(set.shapes.front())};
    }
    const TargetShape* found = set.find(shape);
    if (!found)
      throw Error(ErrorKind::invalid_input,
                  std::string(file) + ": has no shape '" + std::string(shape) + "'");
    return mimicry_target_curves{*found};
  });
}

mimicry_status mimicry_target_curves_write(const mimicry_target_curves* curves, const char* shape,
                                           const char* note, mimicry_bytes** out) {
  return made(out, [&] {
    require(curves, "curves");
    TargetSet set{{curves->shape}};
    set.shapes.front().name = text(shape, "shape");
    return mimicry_bytes{write_targets(set, note ? note : "")};
  });
}

void mimicry_target_curves_destroy(mimicry_target_curves* curves) {
  delete curves;
}

double mimicry_target_curves_metres_per_unit(const mimicry_target_curves* curves) {
  return curves ? curves->shape.scale : 0.0;
}
size_t mimicry_target_curves_count(const mimicry_target_curves* curves) {
  return curves ? curves->shape.curves.size() : 0;
}
size_t mimicry_target_curves_point_count(const mimicry_target_curves* curves, size_t number) {
  const TargetCurve* curve = curve_at(curves, number);
  return curve ? curve->points.size() : 0;
}
size_t mimicry_target_curves_keypoint_count(const mimicry_target_curves* curves, size_t number) {
  const TargetCurve* curve = curve_at(curves, number);
  return curve ? curve->keypoints.size() : 0;
}

mimicry_status mimicry_target_curves_points(const mimicry_target_curves* curves, size_t number,
                                            const mimicry_target* target,
                                            mimicry_surface_point* points) {
  return guarded([&] {
    require(curves, "curves");
    require(target, "target");
    const TargetCurve* curve = curve_at(curves, number);
    if (!curve)
      throw Error(ErrorKind::invalid_input, "curve " + std::to_string(number) + " of " +
                                                std::to_string(curves->shape.curves.size()));
    const Target& t = *target->target;
    require_fits(curves->shape, t.mesh());
    if (!curve->points.empty()) require(points, "points");
    for (std::size_t i = 0; i < curve->points.size(); ++i)
      points[i] = from_point(t, curve->points[i], t.position(curve->points[i]), 0.0);
  });
}

const int32_t* mimicry_target_curves_keypoints(const mimicry_target_curves* curves, size_t number) {
  const TargetCurve* curve = curve_at(curves, number);
  return curve && !curve->keypoints.empty() ? curve->keypoints.data() : nullptr;
}
