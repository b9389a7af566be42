#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <mimicry/assets/canvas.h>

#include "lab/study_shapes.h"

namespace mimicry::lab {

struct SimulatedStudyOptions {
  StudyShapeOptions shapes;
  std::vector<std::string> techniques = {"spraycan", "mimicry"};  ///< the study's methods
  std::string out;  ///< folder for the participants' folders, p00, p01 ...
  Index count = 20;
  std::uint64_t seed = 1;  ///< of all that is random
  double rate_hz = 90.0;
  int threads = 0;  ///< 0: as many as the machine has
};

/// Simulated participants do the whole study (docs/participants.md). Writes a folder for each;
/// a folder with a sequence is whole. Returns the number of strokes. Same options, same bytes.
/// Throws Error(invalid_input) for a technique or shape that does not exist or is named twice,
/// Error(io) where files cannot be read or written, or another program writes there.
std::size_t simulate_study(const SimulatedStudyOptions& options, const Monitor& monitor = {});

}  // namespace mimicry::lab
