#include <cmath>

#include "capi/handles.h"

using namespace mimicry;
using namespace mimicry::capi;

// Many points in one call.

mimicry_status mimicry_target_closest_points(const mimicry_target* target, const double* points,
                                             size_t count, double upper_bound,
                                             mimicry_surface_point* out) {
  return guarded([&] {
    require(target, "target");
    if (std::isnan(upper_bound) || upper_bound < 0.0)
      throw Error(ErrorKind::invalid_input, "upper_bound is " + std::to_string(upper_bound) +
                                                "; give 0 or more, or INFINITY for no bound");
    if (count > 0) {
      require(points, "points");
      require(out, "out");
    }
    Index hint = kNone;
    for (size_t i = 0; i < count; ++i) {
      const auto found = target->target->closest_point(vec3(points + 3 * i), upper_bound, hint);
      if (found) hint = found->surface.face;
      out[i] = from_found(*target->target, found);
    }
  });
}

mimicry_status mimicry_target_first_hits(const mimicry_target* target, const double* origins,
                                         const double* directions, size_t count,
                                         mimicry_surface_point* out) {
  return guarded([&] {
    require(target, "target");
    if (count > 0) {
      require(origins, "origins");
      require(directions, "directions");
      require(out, "out");
    }
    for (size_t i = 0; i < count; ++i)
      out[i] = from_found(*target->target, target->target->first_hit(vec3(origins + 3 * i),
                                                                     vec3(directions + 3 * i)));
  });
}

namespace {

mimicry_answer answer_of(ScpLabel label) {
  switch (label) {
    case ScpLabel::smooth:
      return MIMICRY_SMOOTH;
    case ScpLabel::outside_shell:
      return MIMICRY_OUTSIDE_SHELL;
    case ScpLabel::no_phong_solution:
      return MIMICRY_NO_SMOOTH_POINT;
    case ScpLabel::replaced:
      return MIMICRY_REPLACED;
  }
  return MIMICRY_NO_POINT;
}

}  // namespace

mimicry_status mimicry_target_smooth_closest_points(const mimicry_target* target,
                                                    const double* points, size_t count,
                                                    int32_t replace_failed,
                                                    mimicry_surface_point* out,
                                                    mimicry_answer* answers) {
  return guarded([&] {
    require(target, "target");
    if (!target->projector)
      throw Error(
          ErrorKind::invalid_input,
          "smooth closest points need the target's bake; bake it (mimicry_bake) or load its "
          ".mimicry file (mimicry_target_with_embedding)");
    if (count > 0) {
      require(points, "points");
      require(out, "out");
    }
    ScpHint hint;
    for (size_t i = 0; i < count; ++i) {
      const Vec3 y = vec3(points + 3 * i);
      const auto found = target->projector->project(y, {replace_failed != 0}, &hint);
      out[i] = found ? from_point(*target->target, found->surface, found->position,
                                  (found->position - y).norm())
                     : from_found(*target->target, std::optional<RayHit>());
      if (answers) answers[i] = found ? answer_of(found->label) : MIMICRY_NO_POINT;
    }
  });
}
