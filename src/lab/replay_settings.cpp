#include "lab/replay_settings.h"

#include <filesystem>

#include <nlohmann/json.hpp>

#include <mimicry/base/error.h>
#include <mimicry/version.h>

#include "files/file.h"
#include "files/names.h"
#include "lab/json.h"

namespace mimicry::lab {
namespace {

namespace fs = std::filesystem;

constexpr const char* kFile = "replay.json";
constexpr const char *kVersion = "version", *kStrokes = "strokes", *kBytes = "bytes",
                     *kTechniques = "techniques", *kShapes = "shapes", *kMesh = "mesh",
                     *kTargets = "targets", *kMisses = "misses", *kFolder = "folder";
constexpr const char *kSplit = "split", *kConnect = "connect";

fs::path absolute_path(const std::string& path) {
  std::error_code trouble;
  const fs::path whole = fs::absolute(to_path(path), trouble);
  if (trouble)
    throw Error(ErrorKind::io, path + ": where this is cannot be told: " + trouble.message() +
                                   "; give a path that begins at the root");
  return whole.lexically_normal();
}

std::string absolute(const std::string& path) {
  return path.empty() ? path : to_text(absolute_path(path));
}

Json to_json(const ReplaySettings& settings) {
  return {{kVersion, settings.version},
          {kStrokes, settings.strokes},
          {kBytes, settings.bytes},
          {kTechniques, settings.techniques},
          {kShapes, settings.shapes},
          {kMesh, settings.mesh},
          {kTargets, settings.targets},
          {kMisses, settings.misses == MissPolicy::split ? kSplit : kConnect}};
}

// A study that was moved as a whole keeps its inner paths.
std::string found(const std::string& path, const fs::path& then, const fs::path& now) {
  std::error_code none;
  const bool is_path = to_path(path).is_absolute();  // and not a built-in shape, or nothing
  if (!is_path || then.empty() || fs::exists(to_path(path), none)) return path;
  const fs::path moved = (now / to_path(path).lexically_relative(then)).lexically_normal();
  return fs::exists(moved, none) ? to_text(moved) : path;
}

}  // namespace

ReplaySettings settings_of(const ReplayOptions& options) {
  ReplaySettings settings;
  settings.version = MIMICRY_VERSION;
  for (const std::string& path : options.strokes) {
    std::error_code none;
    const auto size = fs::file_size(to_path(path), none);
    settings.strokes.push_back(absolute(path));
    settings.bytes.push_back(none ? 0 : size);
  }
  for (const TechniqueInfo* info : options.techniques) settings.techniques.emplace_back(info->name);
  settings.shapes = absolute(options.shapes);
  std::error_code none;  // a built-in shape need not be a file's name
  settings.mesh = fs::exists(to_path(options.mesh), none) ? absolute(options.mesh) : options.mesh;
  settings.targets = absolute(options.targets);
  settings.misses = options.misses;
  settings.folder = absolute(options.out);
  return settings;
}

std::string settings_line(const ReplaySettings& settings) {
  return json_text(to_json(settings), -1);
}

void write_settings(const std::string& folder, const ReplaySettings& settings) {
  Json json = to_json(settings);
  json[kFolder] = settings.folder;
  write_file_atomically(join_path(folder, kFile), json_text(json, 2) + "\n");
}

std::optional<ReplaySettings> read_settings(const std::string& folder) {
  const fs::path path = to_path(folder) / kFile;
  std::error_code none;
  if (!fs::exists(path, none)) return std::nullopt;
  try {
    const Json json = Json::parse(read_file(to_text(path), Accept::regular));
    ReplaySettings settings;
    settings.folder = json.value(kFolder, "");
    const fs::path now = absolute_path(folder);
    const auto path_of = [&](const std::string& then) { return found(then, settings.folder, now); };
    settings.version = json.value(kVersion, "");
    for (const Json& stroke : json.at(kStrokes))
      settings.strokes.push_back(path_of(stroke.get<std::string>()));
    settings.shapes = path_of(json.value(kShapes, ""));
    settings.mesh = path_of(json.value(kMesh, ""));
    settings.targets = path_of(json.value(kTargets, ""));
    if (json.value(kMisses, "") == kSplit) settings.misses = MissPolicy::split;
    return settings;
  } catch (const Json::exception& error) {
    throw Error(ErrorKind::invalid_input,
                to_text(path) + ": is no settings of mimicry replay: " + error.what() +
                    "; remove it, or name --recordings, --shapes and "
                    "--targets");
  }
}

}  // namespace mimicry::lab
