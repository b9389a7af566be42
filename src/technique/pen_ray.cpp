#include "technique/pen_ray.h"

#include <mimicry/spatial/pseudonormal.h>

namespace mimicry::technique {

std::optional<SurfacePoint> surface_dipped_through(const spatial::Target& target,
                                                   const stroke::Frame& frame,
                                                   const Vec3& direction, Index hint) {
  const Vec3& pen = frame.controller.position;
  const auto closest = target.closest_point(pen, kInfinity, hint);
  if (!closest) return std::nullopt;
  const Vec3 normal = spatial::pseudonormal(target, closest->surface);
  if (!(normal.dot(pen - closest->position) < 0.0)) return std::nullopt;
  // A head that is inside too (of a room) sees the surface from there: nothing was gone through.
  const Vec3 sight = frame.head.position - pen;
  const auto out = target.first_hit(pen, sight);
  if (!out || !(out->distance < sight.norm())) return std::nullopt;
  if (!(face_normal(target.mesh(), out->surface.face).dot(sight) > 0.0)) return std::nullopt;
  const bool faces_head = normal.dot(frame.head.position - closest->position) > 0.0;
  const bool faces_pen = normal.dot(direction) < 0.0;
  return faces_head || faces_pen ? closest->surface : out->surface;
}

Step pen_ray(const Canvas& canvas, const Memory& memory, const stroke::Frame& frame,
             const Vec3& direction, const Options& options) {
  const spatial::Target& target = *canvas.target;
  const Vec3& pen = frame.controller.position;
  const Index hint = memory.surface.face;
  if (const auto touched = target.closest_point(pen, kTouching * target.diagonal(), hint))
    return ink(Answer::closest, touched->surface, touched->position, memory, frame);
  if (options.dipped_pen != 0.0) {
    if (const auto q = surface_dipped_through(target, frame, direction, hint))
      return ink(Answer::closest, *q, target.position(*q), memory, frame);
  }
  const auto hit = target.first_hit(pen, direction);
  return hit ? ink(Answer::ray, hit->surface, hit->position, memory, frame) : miss(memory);
}

}  // namespace mimicry::technique
