#include "lab/drawing.h"

namespace mimicry::lab {

Drawing draw_again(const Canvas& canvas, const TechniqueInfo& technique, const Stroke& stroke,
                   MissPolicy misses) {
  SessionOptions options;
  options.misses = misses;
  options.expected_frames = stroke.frames.size();
  StrokeSession session(canvas, technique, options);
  session.begin(stroke.model_to_world);
  for (const Frame& frame : stroke.frames) session.add(frame);
  session.end();
  return {session.curve(), session.counts()};
}

}  // namespace mimicry::lab
