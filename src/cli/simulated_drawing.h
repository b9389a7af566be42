#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include <mimicry/curve/projected_curve.h>
#include <mimicry/io/csv.h>
#include <mimicry/study/participants.h>
#include <mimicry/technique/technique.h>

namespace mimicry::cli {

/// What a simulated person drew with a technique whose ink was seen.
struct SimulatedDrawing {
  stroke::Stroke stroke;  ///< says that it is simulated
  curve::ProjectedCurve curve;
};

/// Who draws what. `seed` is the program's, kept in the stroke; `trial` tells a person's strokes
/// apart. Keypoints that are empty are computed.
struct SimulatedTask {
  const stroke::Intention& intended;
  std::span<const Index> keypoints;
  study::TaskKind kind;
  Similarity placed;
  std::uint64_t seed;
  std::uint64_t trial;
};

SimulatedDrawing draw_simulated(const technique::Canvas& canvas,
                                const technique::TechniqueInfo& technique,
                                const SimulatedTask& task, const study::PopulationOptions& options,
                                const study::Participant& person);

/// This program's mark on strokes that it makes up. technique: whose ink was seen, or empty.
stroke::Simulation simulation_mark(std::uint64_t seed, std::string_view technique);

/// The mark in a table of measured strokes: "mimicry 0.1.0 seed 1"; none for other strokes.
io::Cell simulation_cell(const std::optional<stroke::Simulation>& simulated);

}  // namespace mimicry::cli
