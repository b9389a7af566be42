#pragma once

#include <string>

#include "cli/report/drawn_strokes.h"

namespace mimicry::cli {

/// Fills in what `sources` does not say from the replay.json that `mimicry replay` leaves beside
/// its rows: strokes, meshes, target curves and what became of misses. Paths that lead nowhere any
/// more are tried as they lay relative to the folder. Without a replay.json nothing changes; throws
/// Error(invalid_input) where it is none of replay's.
void add_replay_sources(const std::string& folder, StrokeSources& sources);

}  // namespace mimicry::cli
