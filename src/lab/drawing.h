#pragma once

#include <mimicry/session/stroke_session.h>

namespace mimicry::lab {

/// A whole stroke, drawn with a technique: the same bits in a replay and in the pictures of its
/// report.
struct Drawing {
  ProjectedCurve curve;
  FrameCounts counts;
};

/// misses: what becomes of frames whose point is undefined.
Drawing draw_again(const Canvas& canvas, const TechniqueInfo& technique, const Stroke& stroke,
                   MissPolicy misses);

}  // namespace mimicry::lab
