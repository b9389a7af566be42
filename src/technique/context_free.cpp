#include "technique/pen_ray.h"

namespace mimicry::technique {
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
             const Options& options) {
  return pen_ray(canvas, memory, frame, frame.controller.position - frame.head.position, options);
}

Step spraycan(const Canvas& canvas, const Memory& memory, const stroke::Frame& frame,
              const Options& options) {
  return pen_ray(canvas, memory, frame, frame.controller.orientation * options.nozzle, options);
}

Step head_centric(const Canvas& canvas, const Memory& memory, const stroke::Frame& frame,
                  const Options&) {
  const auto hit = canvas.target->first_hit(frame.head.position, frame.head.forward());
  return hit ? ink(Answer::ray, hit->surface, hit->position, memory, frame) : miss(memory);
}

Step snap(const Canvas& canvas, const Memory& memory, const stroke::Frame& frame, const Options&) {
  const auto closest =
      canvas.target->closest_point(frame.controller.position, kInfinity, memory.surface.face);
  return closest ? ink(Answer::closest, closest->surface, closest->position, memory, frame)
                 : miss(memory);
}

}  // namespace mimicry::technique
