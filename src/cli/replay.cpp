#include "lab/replay.h"

#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "cli/commands.h"
#include "cli/console.h"
#include "cli/options.h"

namespace mimicry::cli {
namespace {

struct ReplayArguments {
  lab::ReplayOptions replay;
  std::vector<std::string> techniques;
  std::string misses = "connect";
};

void run_replay(ReplayArguments args, int& status) {
  for (const std::string& name : args.techniques)
    args.replay.techniques.push_back(&find_technique(name));
  if (args.misses == "split") args.replay.misses = MissPolicy::split;
  const lab::ReplayResult result = lab::replay_strokes(args.replay, terminal_monitor());
  std::printf("%s: %zu rows, %zu of them rejected\n", result.rows_file.c_str(), result.rows,
              result.rejected);
  if (result.rejected > 0 || result.rows == 0)
    status = result.rejected < result.rows ? kPartly : kBadInput;
}

}  // namespace

void add_replay(CLI::App& app, int& status) {
  auto* command = app.add_subcommand(
      "replay", "Draw recorded strokes again with any technique, and measure the curves");
  auto args = std::make_shared<ReplayArguments>();
  command
      ->add_option("--strokes", args->replay.strokes,
                   "mimicry-strokes files, and folders of a study's participants")
      ->required();
  command->add_option("-t,--techniques", args->techniques, "Names (mimicry techniques)")
      ->delimiter(',')
      ->required();
  command->add_option("--shapes", args->replay.shapes,
                      "Folder of the targets' mesh files (default: the built-in shapes)");
  command->add_option("--mesh", args->replay.mesh,
                      std::string("All strokes were drawn on this one: ") + kMeshHelp);
  command->add_option("--targets", args->replay.targets,
                      "Target curves; needed for participants' folders");
  command
      ->add_option("-o,--out", args->replay.out,
                   "Folder for rows.csv and rows.jsonl; an interrupted run goes on there")
      ->required();
  command->add_option("--misses", args->misses, "Where a point is undefined: connect or split")
      ->check(CLI::IsMember({"connect", "split"}))
      ->capture_default_str();
  add_threads_option(*command, args->replay.threads);
  command->callback([args, &status] { run_replay(*args, status); });
}

}  // namespace mimicry::cli
