#pragma once

#include <cstdint>
#include <span>

#include <mimicry/curve/projected_curve.h>
#include <mimicry/study/simulate.h>
#include <mimicry/technique/technique.h>

namespace mimicry::lab {

/// What a simulated person drew with a technique whose ink was seen.
struct SimulatedDrawing {
  Stroke stroke;  ///< says that it is simulated
  ProjectedCurve curve;
};

/// Who draws what. `seed` is the program's, kept in the stroke; `trial` tells a person's strokes
/// apart. Keypoints that are empty are computed.
struct SimulatedTask {
  const Intention& intended;
  std::span<const Index> keypoints;
  TaskKind kind;
  Similarity placed;
  std::uint64_t seed;
  std::uint64_t trial;
};

SimulatedDrawing draw_simulated(const Canvas& canvas, const TechniqueInfo& technique,
                                const SimulatedTask& task, const PopulationOptions& options,
                                const Participant& person);

}  // namespace mimicry::lab
