#include "cli/options.h"

#include <cmath>
#include <string>

#include <mimicry/assets/canvas.h>
#include <mimicry/base/parallel.h>

#include "cli/console.h"
#include "io/number.h"

namespace mimicry::cli {

CLI::Validator number_between(double lowest, double highest) {
  const std::string range = format_double(lowest) + " to " + format_double(highest);
  return CLI::Validator(
      [=](std::string& text) -> std::string {
        const auto value = parse_double(text);
        if (value && std::isfinite(*value) && *value >= lowest && *value <= highest) return "";
        return "'" + text + "' is not a number from " + range;
      },
      range);
}

void add_threads_option(CLI::App& command, int& threads) {
  command.add_option("--threads", threads, "At most; 0: as many as the machine has")
      ->check(CLI::Range(0, kMostThreads))
      ->capture_default_str();
}

void add_cache_option(CLI::App& command, BakeSettings& settings) {
  command.add_flag("!--no-cache", settings.use_cache,
                   "Bake anew and keep nothing (bakes are kept in MIMICRY_CACHE, "
                   "XDG_CACHE_HOME/mimicry or ~/.cache/mimicry)");
}

void add_target_options(CLI::App& command, TargetOptions& options) {
  command.add_flag("!--no-join", options.join,
                   "Leave vertices at one position apart: curves stop at seams");
  command.add_flag("--strict", options.strict,
                   "Refuse a mesh with flaws (edges of three or more faces, faces twice or turned "
                   "...) rather than draw on what it is meant to be");
  command
      .add_flag_callback(
          "--allow-nonmanifold",
          [] { complain("--allow-nonmanifold is no longer needed: every mesh can be drawn on"); })
      ->group("");
}

void add_study_shape_options(CLI::App& command, lab::StudyShapeOptions& options) {
  command.add_option("--shapes", options.folder,
                     "Folder of the shapes' mesh files (default: the built-in shapes)");
  command.add_option("--targets", options.targets, "File of the shapes' target curves")->required();
  command.add_option("--only", options.names, "Only these shapes")->delimiter(',');
}

}  // namespace mimicry::cli
