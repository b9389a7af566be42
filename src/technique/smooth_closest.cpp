#include <cassert>

#include "spatial/pseudonormal.h"
#include "technique/pen_ray.h"
#include "technique/soft_anchor.h"

namespace mimicry {
namespace {

Answer answer_of(ScpLabel label) {
  switch (label) {
    case ScpLabel::smooth:
      return Answer::smooth;
    case ScpLabel::outside_shell:
      return Answer::outside_shell;
    case ScpLabel::no_phong_solution:
      return Answer::no_phong_solution;
    case ScpLabel::replaced:
      return Answer::replaced;
  }
  return Answer::miss;
}

Index& tet_hint(SearchHint& hint) {
  return hint.tet;
}
Index& tet_hint(Anchor& anchor) {
  return anchor.tet;
}

// Inks SCP(y).
template <class OwnMemory>
Stepped<OwnMemory> smooth_closest(const Canvas& canvas, OwnMemory memory, const Frame& frame,
                                  bool replace_failed, const Vec3& y) {
  assert(canvas.projector && "the technique needs a bake (TechniqueInfo::needs_bake)");
  ScpHint hint{tet_hint(memory), face_hint(memory)};
  const auto q = canvas.projector.project(y, {replace_failed}, &hint);
  if (!q) return miss(memory);
  tet_hint(memory) = hint.tet;
  return stepped({answer_of(q->label), q->surface, q->position}, memory, frame);
}

// r without its part along the gradient g of the distance.
Stepped<Anchor> along_offset(const Canvas& canvas, const Anchor& memory, const Frame& frame,
                             const SpraySmoothOptions& options, const Vec3& r,
                             const Vec3& gradient_at) {
  const auto g = distance_gradient(canvas.target, gradient_at, memory.surface.face);
  if (!g) return miss(memory);
  const Vec3 motion = frame.controller.position - memory.pen;
  return smooth_closest(canvas, memory, frame, options.replace_failed, r - motion.dot(*g) * *g);
}

}  // namespace

// Paper, 3.1.2: as snap, but with the smooth closest point.
Stepped<SearchHint> snap_smooth(const Canvas& canvas, const SearchHint& memory, const Frame& frame,
                                const SmoothClosestOptions& options) {
  return smooth_closest(canvas, memory, frame, options.replace_failed, frame.controller.position);
}

// Paper, Eq. mimicry: q_i = SCP(r_i), r_i = q_{i-1} + dp_i.
Stepped<SoftAnchor> mimicry(const Canvas& canvas, const SoftAnchor& memory, const Frame& frame,
                            const MimicryOptions& options) {
  if (!memory.anchored) return spray(canvas, memory, frame, options);
  return step_in_parts(
      canvas, memory, frame, options, [&](const SoftAnchor& from, const Frame& to) {
        const Vec3 r = anchored_point(canvas, from, to, options);
        Stepped<SoftAnchor> step = without_jump(
            canvas, from, to, options, smooth_closest(canvas, from, to, options.replace_failed, r));
        keep_rest(canvas, from, to, options, r, step);
        return step;
      });
}

// Paper, Eq. offset: the motion's part across the offset surface through p_i is dropped,
// q_i = SCP(r_i - (dp_i . g) g), g the gradient of the signed distance at p_i, whose sign cancels.
Stepped<Anchor> mimicry_offset(const Canvas& canvas, const Anchor& memory, const Frame& frame,
                               const SpraySmoothOptions& options) {
  if (!memory.anchored) return spray(canvas, memory, frame, options);
  const Vec3 r = memory.position + (frame.controller.position - memory.pen);
  return along_offset(canvas, memory, frame, options, r, frame.controller.position);
}

// Paper, Eq. parallel: the same with the gradient at r_i.
Stepped<Anchor> mimicry_parallel(const Canvas& canvas, const Anchor& memory, const Frame& frame,
                                 const SpraySmoothOptions& options) {
  if (!memory.anchored) return spray(canvas, memory, frame, options);
  const Vec3 r = memory.position + (frame.controller.position - memory.pen);
  return along_offset(canvas, memory, frame, options, r, r);
}

}  // namespace mimicry
