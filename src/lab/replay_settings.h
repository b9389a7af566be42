#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "lab/replay.h"

namespace mimicry::lab {

/// What decides the rows of a replay, with full paths: an interrupted run is only taken up by the
/// same. Kept as replay.json beside the rows, where reports find the strokes by it.
struct ReplaySettings {
  std::string version;
  std::vector<std::string> strokes;
  std::vector<std::uintmax_t> bytes;  ///< of the strokes' files
  std::vector<std::string> techniques;
  std::string shapes, mesh, targets;
  MissPolicy misses = MissPolicy::connect;
  std::string folder;  ///< where it lay; not part of what decides
};

ReplaySettings settings_of(const ReplayOptions& options);

/// One line without its end and without the folder.
std::string settings_line(const ReplaySettings& settings);
/// Writes replay.json in a folder. Throws Error(io).
void write_settings(const std::string& folder, const ReplaySettings& settings);
/// Reads replay.json of a folder; nullopt where there is none. Throws Error(invalid_input) where it
/// is none of replay's. Paths that lead nowhere any more are tried as they lay relative to the
/// folder, so that a study that was moved as a whole is found.
std::optional<ReplaySettings> read_settings(const std::string& folder);

}  // namespace mimicry::lab
