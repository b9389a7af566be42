#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <mimicry/assets/canvas.h>
#include <mimicry/session/stroke_session.h>
#include <mimicry/technique/technique.h>

namespace mimicry::lab {

struct ReplayOptions {
  std::vector<std::string> strokes;  ///< mimicry-strokes files, and participants' folders
  std::vector<const TechniqueInfo*> techniques;
  std::string shapes;   ///< folder of the targets' mesh files; empty: built-in shapes
  std::string mesh;     ///< what all strokes were drawn on; empty: the shapes that they name
  std::string targets;  ///< file of target curves, which participants' folders need
  std::string out;      ///< folder for the tables
  MissPolicy misses = MissPolicy::connect;
  int threads = 0;  ///< 0: as many as the machine has
};

struct ReplayResult {
  std::string rows_file;  ///< rows.csv
  std::size_t rows = 0;   ///< with those of the runs before
  std::size_t rejected = 0;
};

/// Draws recorded strokes again with each technique and measures the curves: rows.csv, rows.jsonl,
/// replay.json and rows.journal in `out` (docs/formats.md). A run that ended anywhere, cancelled or
/// killed, goes on there when it is called with the same options, and gives the same bytes.
/// What cannot be measured gets a row with the reason, of which the monitor hears.
/// Throws Error(invalid_input) where `out` holds the rows of another run, Error(io) where strokes
/// are not there or another program writes to `out`.
ReplayResult replay_strokes(const ReplayOptions& options, const Monitor& monitor = {});

}  // namespace mimicry::lab
