#include <cassert>

#include <mimicry/spatial/pseudonormal.h>

#include "technique/soft_anchor.h"
#include "technique/steps.h"

namespace mimicry::technique {
namespace {

Answer answer_of(embedding::ScpLabel label) {
  switch (label) {
    case embedding::ScpLabel::smooth:
      return Answer::smooth;
    case embedding::ScpLabel::outside_shell:
      return Answer::outside_shell;
    case embedding::ScpLabel::no_phong_solution:
      return Answer::no_phong_solution;
    case embedding::ScpLabel::replaced:
      return Answer::replaced;
  }
  return Answer::miss;
}

// Inks SCP(y).
Step smooth_closest(const Canvas& canvas, const Memory& memory, const stroke::Frame& frame,
                    const Options& options, const Vec3& y) {
  assert(canvas.projector && "the technique needs a bake (TechniqueInfo::needs_bake)");
  embedding::ScpHint hint{memory.tet, memory.surface.face};
  const auto q = canvas.projector->project(y, {options.replace_failed != 0.0}, &hint);
  if (!q) return miss(memory);
  Step step = ink(answer_of(q->label), q->surface, q->position, memory, frame);
  step.memory.tet = hint.tet;
  return step;
}

// r without its part along the gradient g of the distance.
Step along_offset(const Canvas& canvas, const Memory& memory, const stroke::Frame& frame,
                  const Options& options, const Vec3& r, const Vec3& gradient_at) {
  const auto g = spatial::distance_gradient(*canvas.target, gradient_at, memory.surface.face);
  if (!g) return miss(memory);
  const Vec3 motion = frame.controller.position - memory.pen;
  return smooth_closest(canvas, memory, frame, options, r - motion.dot(*g) * *g);
}

}  // namespace

// Paper, 3.1.2: as snap, but with the smooth closest point.
Step snap_smooth(const Canvas& canvas, const Memory& memory, const stroke::Frame& frame,
                 const Options& options) {
  return smooth_closest(canvas, memory, frame, options, frame.controller.position);
}

// Paper, Eq. mimicry: q_i = SCP(r_i), r_i = q_{i-1} + dp_i.
Step mimicry(const Canvas& canvas, const Memory& memory, const stroke::Frame& frame,
             const Options& options) {
  if (!memory.anchored) return spraycan(canvas, memory, frame, options);
  return step_in_parts(
      canvas, memory, frame, options, [&](const Memory& from, const stroke::Frame& to) {
        const Vec3 r = anchored_point(canvas, from, to, options);
        Step step =
            without_jump(canvas, from, to, options, smooth_closest(canvas, from, to, options, r));
        keep_rest(canvas, from, to, options, r, step);
        return step;
      });
}

// Paper, Eq. offset: the motion's part across the offset surface through p_i is dropped,
// q_i = SCP(r_i - (dp_i . g) g), g the gradient of the signed distance at p_i, whose sign cancels.
Step mimicry_offset(const Canvas& canvas, const Memory& memory, const stroke::Frame& frame,
                    const Options& options) {
  if (!memory.anchored) return spraycan(canvas, memory, frame, options);
  const Vec3 r = memory.position + (frame.controller.position - memory.pen);
  return along_offset(canvas, memory, frame, options, r, frame.controller.position);
}

// Paper, Eq. parallel: the same with the gradient at r_i.
Step mimicry_parallel(const Canvas& canvas, const Memory& memory, const stroke::Frame& frame,
                      const Options& options) {
  if (!memory.anchored) return spraycan(canvas, memory, frame, options);
  const Vec3 r = memory.position + (frame.controller.position - memory.pen);
  return along_offset(canvas, memory, frame, options, r, r);
}

}  // namespace mimicry::technique
