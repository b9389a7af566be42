#include "technique/memory.h"

namespace mimicry {

void remember(Anchor& anchor, const TechniqueStep& step, const Frame& frame) {
  const Vec3& pen = frame.controller.position;
  if (!anchor.anchored) {
    anchor.points = 1;
  } else if (pen != anchor.pen) {
    ++anchor.points;
    anchor.motion = pen - anchor.pen;
  }
  anchor.anchored = true;
  anchor.pen = pen;
  anchor.surface = step.surface;
  anchor.position = step.position;
  anchor.time_s = frame.time_s;
}

}  // namespace mimicry
