#include "technique/steps.h"

namespace mimicry::technique {

// Paper, section 4.1: the hand's motion is carried over to the last point, r_i = q_{i-1} + dp_i,
// and the result is brought back to the surface.
Step anchored_closest(const Canvas& canvas, const Memory& memory, const stroke::Frame& frame,
                      const Options& options) {
  if (!memory.anchored) return spraycan(canvas, memory, frame, options);
  const Vec3 r = memory.position + (frame.controller.position - memory.pen);
  const auto closest = canvas.target->closest_point(r, kInfinity, memory.surface.face);
  return closest ? ink(Answer::closest, closest->surface, closest->position, memory, frame)
                 : miss(memory);
}

}  // namespace mimicry::technique
