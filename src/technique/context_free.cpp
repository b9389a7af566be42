#include "technique/steps.h"

namespace mimicry::technique {
namespace {

Step first_hit(const Canvas& canvas, const Memory& memory, const stroke::Frame& frame,
               const Vec3& origin, const Vec3& direction) {
  const auto hit = canvas.target->first_hit(origin, direction);
  return hit ? ink(Answer::ray, hit->surface, hit->position, memory, frame) : miss(memory);
}

}  // namespace

Step ink(Answer answer, const SurfacePoint& surface, const Vec3& position, const Memory& memory,
         const stroke::Frame& frame) {
  Step step{answer, surface, position, memory};
  step.memory.anchored = true;
  step.memory.pen = frame.controller.position;
  step.memory.surface = surface;
  step.memory.position = position;
  step.memory.time_s = frame.time_s;
  if (!memory.anchored) {
    step.memory.points = 1;
  } else if (frame.controller.position != memory.pen) {
    step.memory.points = memory.points + 1;
    step.memory.motion = frame.controller.position - memory.pen;
  }
  return step;
}

Step miss(const Memory& memory) {
  return {Answer::miss, {}, Vec3::Zero(), memory};
}

Step occlude(const Canvas& canvas, const Memory& memory, const stroke::Frame& frame,
             const Options&) {
  const Vec3& pen = frame.controller.position;
  return first_hit(canvas, memory, frame, pen, pen - frame.head.position);
}

Step spraycan(const Canvas& canvas, const Memory& memory, const stroke::Frame& frame,
              const Options& options) {
  return first_hit(canvas, memory, frame, frame.controller.position,
                   frame.controller.orientation * options.nozzle);
}

Step head_centric(const Canvas& canvas, const Memory& memory, const stroke::Frame& frame,
                  const Options&) {
  return first_hit(canvas, memory, frame, frame.head.position, frame.head.forward());
}

Step snap(const Canvas& canvas, const Memory& memory, const stroke::Frame& frame, const Options&) {
  const auto closest =
      canvas.target->closest_point(frame.controller.position, kInfinity, memory.surface.face);
  return closest ? ink(Answer::closest, closest->surface, closest->position, memory, frame)
                 : miss(memory);
}

}  // namespace mimicry::technique
