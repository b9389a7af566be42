#include "technique/pen_ray.h"

namespace mimicry {

Stepped<SearchHint> occlude(const Canvas& canvas, const SearchHint& memory, const Frame& frame,
                            const SightOptions& options) {
  const Vec3 sight = frame.controller.position - frame.head.position;
  return stepped(pen_ray(canvas, frame, sight, memory.face, options), memory, frame);
}

Stepped<SearchHint> spraycan(const Canvas& canvas, const SearchHint& memory, const Frame& frame,
                             const SprayOptions& options) {
  return spray(canvas, memory, frame, options);
}

Stepped<NoMemory> head_centric(const Canvas& canvas, const NoMemory& memory, const Frame& frame,
                               const NoOptions&) {
  const auto hit = canvas.target.first_hit(frame.head.position, frame.head.forward());
  return hit ? stepped({Answer::ray, hit->surface, hit->position}, memory, frame) : miss(memory);
}

Stepped<SearchHint> snap(const Canvas& canvas, const SearchHint& memory, const Frame& frame,
                         const NoOptions&) {
  const auto closest =
      canvas.target.closest_point(frame.controller.position, kInfinity, memory.face);
  return closest ? stepped({Answer::closest, closest->surface, closest->position}, memory, frame)
                 : miss(memory);
}

}  // namespace mimicry
