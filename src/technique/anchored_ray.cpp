#include <optional>

#include "technique/pen_ray.h"

namespace mimicry {
namespace {

// Relative lengths below which a direction is rounding.
constexpr double kNoDirection = 1e-9;
// 1 + cos of motions that are exactly reversed.
constexpr double kReversed = 1e-12;

// The nearer hit of the two rays from r, along and against the direction; of equally near ones that
// along it.
Stepped<DirectedAnchor> nearer_hit(const Canvas& canvas, const DirectedAnchor& memory,
                                   const Frame& frame, const Vec3& r, const Vec3& direction) {
  const auto along = canvas.target.first_hit(r, direction);
  const auto against = canvas.target.first_hit(r, -direction);
  if (!along && !against) return miss(memory);
  const RayHit& hit =
      !against || (along && along->distance <= against->distance) ? *along : *against;
  DirectedAnchor kept = memory;
  kept.direction = direction;
  return stepped({Answer::ray, hit.surface, hit.position}, kept, frame);
}

// The smallest rotation that turns `from` to the direction of `to`, applied to x; x itself where
// one of them vanishes or they are opposite.
Vec3 transported(const Vec3& x, const Vec3& from, const Vec3& to) {
  const double from_length = from.norm(), to_length = to.norm();
  if (!(from_length > 0.0 && to_length > 0.0)) return x;
  const Vec3 a = from / from_length, b = to / to_length;
  const double cosine = a.dot(b);
  if (1.0 + cosine <= kReversed) return x;
  const Vec3 axis = a.cross(b);  // of length sine
  return cosine * x + axis.cross(x) + axis.dot(x) / (1.0 + cosine) * axis;
}

}  // namespace

// Paper, section 4.3: rays from r_i across the motion, in its plane with the last ray from pen to
// surface: d = dp_i x (dp_i x (p_{i-1} - q_{i-1})). Where that vanishes the last d serves. A
// stroke that starts with the pen on the surface has no such ray: its normal serves.
Stepped<DirectedAnchor> anchored_ray_plane(const Canvas& canvas, const DirectedAnchor& memory,
                                           const Frame& frame, const SprayOptions& options) {
  if (!memory.anchored) return spray(canvas, memory, frame, options);
  const Vec3 motion = frame.controller.position - memory.pen;
  if (!(motion.cwiseAbs().maxCoeff() <= kFarthestHand)) return miss(memory);
  Vec3 lift = memory.pen - memory.position;
  if (memory.direction.isZero(0.0) && !(lift.norm() > kNoDirection * canvas.target.diagonal()))
    lift = canvas.target.normal(memory.surface);
  const double speed = motion.norm();
  const Vec3 along = speed > 0.0 ? Vec3(motion / speed) : Vec3(Vec3::Zero());
  const Vec3 d = along.cross(along.cross(lift));
  const double length = d.norm();
  const bool is_defined = length > kNoDirection * lift.norm();
  if (!is_defined && memory.direction.isZero(0.0)) return miss(memory);
  return nearer_hit(canvas, memory, frame, memory.position + motion,
                    is_defined ? Vec3(d / length) : memory.direction);
}

// Paper, section 4.3: the last ray's direction q_{i-1} - p_{i-1}, turned as the motion has turned
// since. Where pen and surface touch the last direction serves, or, before there was any, the
// surface's normal.
Stepped<DirectedAnchor> anchored_ray_transport(const Canvas& canvas, const DirectedAnchor& memory,
                                               const Frame& frame, const SprayOptions& options) {
  if (!memory.anchored) return spray(canvas, memory, frame, options);
  const Vec3 motion = frame.controller.position - memory.pen;
  if (!(motion.cwiseAbs().maxCoeff() <= kFarthestHand)) return miss(memory);
  const Vec3 ray = memory.position - memory.pen;
  const double length = ray.norm();
  const bool is_defined = length > kNoDirection * canvas.target.diagonal();
  Vec3 direction = is_defined ? Vec3(ray / length) : memory.direction;
  if (direction.isZero(0.0)) direction = -canvas.target.normal(memory.surface);
  return nearer_hit(canvas, memory, frame, memory.position + motion,
                    transported(direction, memory.motion, motion));
}

}  // namespace mimicry
