#include "technique/pen_ray.h"
#include "technique/planar_section.h"

namespace mimicry {
namespace {

// The sine between two motions below which they do not span a plane.
constexpr double kParallel = 1e-9;

Vec3 unit_or_zero(const Vec3& v) {
  const double length = v.norm();
  return length > 0.0 ? Vec3(v / length) : Vec3(Vec3::Zero());
}

}  // namespace

// Paper, section 4.2: the curve goes on within the plane N_i of the hand's last two motions,
// through r_i = q_{i-1} + dp_i: the closest point to r_i of the section that q_{i-1} lies on. The
// first two points are sprayed. While the motions span no plane the last one is kept, through
// q_{i-1}; before there was any, the closest point serves.
Stepped<DirectedAnchor> mimicry_planar(const Canvas& canvas, const DirectedAnchor& memory,
                                       const Frame& frame, const SprayOptions& options) {
  if (memory.points < 2) return spray(canvas, memory, frame, options);
  const Vec3 motion = frame.controller.position - memory.pen;
  if (!(motion.cwiseAbs().maxCoeff() <= kFarthestHand)) return miss(memory);
  const Vec3 r = memory.position + motion;
  const Vec3 normal = unit_or_zero(motion).cross(unit_or_zero(memory.motion));
  const double sine = normal.norm();
  DirectedAnchor kept = memory;
  if (sine > kParallel) {
    kept.direction = normal / sine;
  } else if (memory.direction.isZero(0.0)) {
    const auto closest = canvas.target.closest_point(r, kInfinity, memory.surface.face);
    return closest ? stepped({Answer::closest, closest->surface, closest->position}, memory, frame)
                   : miss(memory);
  }
  const Target& target = canvas.target;
  const SurfacePoint q = closest_on_section(target.surface(), memory.surface, kept.direction, r);
  return stepped({Answer::section, q, target.position(q)}, kept, frame);
}

}  // namespace mimicry
