#include "technique/pen_ray.h"

#include "spatial/pseudonormal.h"

namespace mimicry {

std::optional<SurfacePoint> surface_dipped_through(const Target& target, const Frame& frame,
                                                   const Vec3& direction, Index hint) {
  const Vec3& pen = frame.controller.position;
  const auto closest = target.closest_point(pen, kInfinity, hint);
  if (!closest) return std::nullopt;
  const Vec3 normal = pseudonormal(target, closest->surface);
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

TechniqueStep pen_ray(const Canvas& canvas, const Frame& frame, const Vec3& direction, Index hint,
                      const SightOptions& options) {
  const Target& target = canvas.target;
  const Vec3& pen = frame.controller.position;
  if (const auto touched = target.closest_point(pen, kTouching * target.diagonal(), hint))
    return {Answer::closest, touched->surface, touched->position};
  if (options.dipped_pen) {
    if (const auto q = surface_dipped_through(target, frame, direction, hint))
      return {Answer::closest, *q, target.position(*q)};
  }
  const auto hit = target.first_hit(pen, direction);
  return hit ? TechniqueStep{Answer::ray, hit->surface, hit->position} : TechniqueStep{};
}

}  // namespace mimicry
