#include "technique/pen_ray.h"

namespace mimicry {

// Paper, section 4.1: the hand's motion is carried over to the last point, r_i = q_{i-1} + dp_i,
// and the result is brought back to the surface.
Stepped<Anchor> anchored_closest(const Canvas& canvas, const Anchor& memory, const Frame& frame,
                                 const SprayOptions& options) {
  if (!memory.anchored) return spray(canvas, memory, frame, options);
  const Vec3 r = memory.position + (frame.controller.position - memory.pen);
  const auto closest = canvas.target.closest_point(r, kInfinity, memory.surface.face);
  return closest ? stepped({Answer::closest, closest->surface, closest->position}, memory, frame)
                 : miss(memory);
}

}  // namespace mimicry
