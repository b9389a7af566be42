#include <cmath>

#include <mimicry/stroke/stroke.h>

#include "base/finite.h"

namespace mimicry {
namespace {

Pose to_model(const Pose& world, const Similarity& model_to_world) {
  return {model_to_world.inverse_point(world.position),
          model_to_world.rotation.conjugate() * world.orientation.normalized()};
}

bool is_place(const Vec3& x) {
  return is_finite(x) && x.cwiseAbs().maxCoeff() <= kFarthest_m;
}

bool is_rotation(const Quat& q) {
  return is_finite(q) && std::abs(q.coeffs().stableNorm() - 1.0) <= kUnitTolerance;
}

std::optional<std::string> pose_problem(const Pose& pose, const char* device) {
  if (!is_place(pose.position))
    return std::string(device) + " position is not finite or beyond 1e9 m";
  if (!is_finite(pose.orientation)) return std::string(device) + " orientation is not finite";
  if (!is_rotation(pose.orientation))
    return std::string(device) + " orientation is a quaternion of length " +
           std::to_string(pose.orientation.coeffs().stableNorm()) + ", not 1";
  return std::nullopt;
}

bool is_fraction(double x) {
  return std::isfinite(x) && x >= 0.0 && x <= 1.0;
}

}  // namespace

Frame to_model(const Frame& world, const Similarity& model_to_world) {
  Frame model = world;
  model.head = to_model(world.head, model_to_world);
  model.controller = to_model(world.controller, model_to_world);
  return model;
}

std::optional<std::string> frame_problem(const Frame& frame, double previous_time_s) {
  if (!std::isfinite(frame.time_s)) return "time is not finite";
  if (frame.time_s < previous_time_s)
    return "time runs backwards, from " + std::to_string(previous_time_s) + " s to " +
           std::to_string(frame.time_s) + " s";
  if (auto problem = pose_problem(frame.head, "head")) return problem;
  if (auto problem = pose_problem(frame.controller, "controller")) return problem;
  if (!is_fraction(frame.trigger)) return "trigger is not between 0 and 1";
  if (frame.pressure && !is_fraction(*frame.pressure)) return "pressure is not between 0 and 1";
  return std::nullopt;
}

bool is_usable(const Frame& frame, double previous_time_s) {
  return std::isfinite(frame.time_s) && frame.time_s >= previous_time_s &&
         is_place(frame.head.position) && is_rotation(frame.head.orientation) &&
         is_place(frame.controller.position) && is_rotation(frame.controller.orientation) &&
         is_fraction(frame.trigger) && (!frame.pressure || is_fraction(*frame.pressure));
}

}  // namespace mimicry
