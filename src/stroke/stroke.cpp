#include <cmath>

#include <mimicry/base/error.h>
#include <mimicry/stroke/stroke.h>

#include "base/finite.h"

namespace mimicry {

void require_usable(const Stroke& stroke) {
  const std::string name = "stroke '" + stroke.id + "'";
  const Similarity& placed = stroke.model_to_world;
  if (!is_finite(placed.translation) || !is_finite(placed.rotation) ||
      !std::isfinite(placed.scale) ||
      !(std::abs(placed.rotation.coeffs().stableNorm() - 1.0) <= kUnitTolerance) ||
      !(placed.scale > 0.0))
    throw Error(ErrorKind::invalid_input,
                name +
                    ": model_to_world is not a similarity; give a finite translation, a unit "
                    "quaternion and a scale above 0");
  double previous = -kInfinity;
  for (std::size_t i = 0; i < stroke.frames.size(); ++i) {
    if (const auto problem = frame_problem(stroke.frames[i], previous))
      throw Error(ErrorKind::invalid_input, name + ": frame " + std::to_string(i) + ": " +
                                                *problem + "; remove the frame or record it again");
    previous = stroke.frames[i].time_s;
  }
}

}  // namespace mimicry
