#include "lab/simulated_drawing.h"

#include <mimicry/session/stroke_session.h>
#include <mimicry/study/targets.h>

#include "study/simulation_mark.h"

namespace mimicry::lab {

SimulatedDrawing draw_simulated(const Canvas& canvas, const TechniqueInfo& technique,
                                const SimulatedTask& task, const PopulationOptions& options,
                                const Participant& person) {
  const Target& target = canvas.target;
  std::vector<Index> known(task.keypoints.begin(), task.keypoints.end());
  if (known.empty()) known = keypoints(target.surface(), task.intended.points, task.placed.scale);
  SessionOptions split;
  split.misses = MissPolicy::split;
  StrokeSession session(canvas, technique, split);
  session.begin(task.placed);
  SimulatedDrawing drawing;
  drawing.stroke = draw_trial(target, task.intended, known, task.kind, task.placed, options, person,
                              technique.steering, task.trial,
                              [&](const Frame& frame) { return session.ink(frame); });
  session.end();
  drawing.stroke.simulated = simulation_mark(task.seed, technique.name);
  drawing.curve = session.curve();
  return drawing;
}

}  // namespace mimicry::lab
