#include "cli/simulated_drawing.h"

#include <optional>
#include <string>

#include <mimicry/session/stroke_session.h>
#include <mimicry/study/keypoints.h>

namespace mimicry::cli {
namespace {

// The nozzle of only this technique decides in every frame.
study::Steering steering_of(const technique::TechniqueInfo& info) {
  return info.name == "spraycan" ? study::Steering::aims : study::Steering::moves;
}

}  // namespace

SimulatedDrawing draw_simulated(const technique::Canvas& canvas,
                                const technique::TechniqueInfo& technique,
                                const SimulatedTask& task, const study::PopulationOptions& options,
                                const study::Participant& person) {
  const spatial::Target& target = *canvas.target;
  std::vector<Index> keypoints(task.keypoints.begin(), task.keypoints.end());
  if (keypoints.empty())
    keypoints = study::keypoints(target.mesh(), target.half_edges(), task.intended.points,
                                 task.placed.scale);
  session::SessionOptions split;
  split.misses = session::MissPolicy::split;
  session::StrokeSession session(canvas, technique, split);
  session.begin(task.placed);
  SimulatedDrawing drawing;
  drawing.stroke = study::draw_trial(
      target, task.intended, keypoints, task.kind, task.placed, options, person,
      steering_of(technique), task.trial, [&](const stroke::Frame& frame) -> std::optional<Vec3> {
        if (session.add(frame) != session::FrameStatus::inked) return std::nullopt;
        return task.placed.point(session.curve().points.back().position);
      });
  session.end();
  drawing.stroke.simulated = simulation_mark(task.seed, technique.name);
  drawing.curve = session.curve();
  return drawing;
}

stroke::Simulation simulation_mark(std::uint64_t seed, std::string_view technique) {
  return {"mimicry " MIMICRY_VERSION, seed, std::string(technique)};
}

io::Cell simulation_cell(const std::optional<stroke::Simulation>& simulated) {
  if (!simulated) return std::monostate();
  return simulated->program + " seed " + std::to_string(simulated->seed);
}

}  // namespace mimicry::cli
