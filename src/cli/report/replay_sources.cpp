#include "cli/report/replay_sources.h"

#include <filesystem>

#include <nlohmann/json.hpp>

#include <mimicry/base/error.h>
#include <mimicry/files/file.h>

namespace mimicry::cli {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

// A study that was moved as a whole keeps its inner paths.
std::string found(const std::string& path, const fs::path& then, const fs::path& now) {
  std::error_code none;
  const bool is_path = fs::path(path).is_absolute();  // and not a built-in shape, or nothing
  if (!is_path || then.empty() || fs::exists(path, none)) return path;
  const fs::path moved = (now / fs::path(path).lexically_relative(then)).lexically_normal();
  return fs::exists(moved, none) ? moved.string() : path;
}

// The name that the rows call it by: the last part of the path, also of "study/p07/".
std::string row_name(const fs::path& path) {
  return (path.has_filename() ? path : path.parent_path()).filename().string();
}

}  // namespace

void add_replay_sources(const std::string& folder, StrokeSources& sources) {
  const fs::path path = fs::path(folder) / "replay.json";
  std::error_code none;
  if (!fs::exists(path, none)) return;
  try {
    const Json settings = Json::parse(files::read_file(path.string(), files::Accept::regular));
    const fs::path then = settings.value("folder", "");
    const fs::path now = fs::absolute(folder).lexically_normal();
    const auto text = [&](const char* key) { return found(settings.value(key, ""), then, now); };
    if (sources.recordings.empty())
      for (const Json& stroke : settings.at("strokes")) {
        const std::string at = found(stroke.get<std::string>(), then, now);
        const auto [entry, is_new] = sources.files.emplace(row_name(at), at);
        if (!is_new && entry->second != at) entry->second.clear();  // two of this name
      }
    if (sources.shapes.empty()) {
      sources.shapes = text("shapes");
      sources.mesh = text("mesh");
    }
    if (sources.targets.empty()) sources.targets = text("targets");
    if (settings.value("misses", "") == "split") sources.misses = session::MissPolicy::split;
  } catch (const Json::exception& error) {
    throw Error(ErrorKind::invalid_input,
                path.string() + ": is no settings of mimicry replay: " + error.what() +
                    "; remove it, or name --recordings, --shapes and "
                    "--targets");
  }
}

}  // namespace mimicry::cli
