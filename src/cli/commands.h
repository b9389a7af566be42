#pragma once

#include <CLI/CLI.hpp>

namespace mimicry::cli {

/// What the program returns (README, "Exit codes").
enum ExitCode : int {
  kDone = 0,
  kBug = 1,          ///< an unexpected failure
  kUsage = 2,        ///< the command line is wrong
  kBadInput = 3,     ///< a mesh, stroke or option that cannot be used; the message says why
  kFileTrouble = 4,  ///< a file that cannot be read or written
  kPartly = 5,       ///< done, but something was left out; the message says what
  kCancelled = 130,  ///< interrupted; nothing is left behind
};

// Each adds one subcommand, which runs when the command line has been parsed. `status` is what the
// program will return.
void add_bake(CLI::App& app, int& status);
void add_bake_worker(CLI::App& app, int& status);
void add_compare(CLI::App& app, int& status);
void add_geodesic(CLI::App& app, int& status);
void add_import_embedding(CLI::App& app, int& status);
void add_info(CLI::App& app, int& status);
void add_keypoints(CLI::App& app, int& status);
void add_measure(CLI::App& app, int& status);
void add_paint(CLI::App& app, int& status);
void add_participants(CLI::App& app, int& status);
void add_project(CLI::App& app, int& status);
void add_quality(CLI::App& app, int& status);
void add_render(CLI::App& app, int& status);
void add_report(CLI::App& app, int& status);
void add_serve(CLI::App& app, int& status);
void add_replay(CLI::App& app, int& status);
void add_scp(CLI::App& app, int& status);
void add_shapes(CLI::App& app, int& status);
void add_simulate(CLI::App& app, int& status);
void add_targets(CLI::App& app, int& status);
void add_techniques(CLI::App& app, int& status);

}  // namespace mimicry::cli
