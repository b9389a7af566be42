#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include <mimicry/base/error.h>
#include <mimicry/base/ordered_work.h>
#include <mimicry/files/file.h>
#include <mimicry/io/csv.h>
#include <mimicry/technique/technique.h>

#include "cli/commands.h"
#include "cli/console.h"
#include "cli/embedding_input.h"
#include "cli/interrupt.h"
#include "cli/mesh_input.h"
#include "cli/replay_jobs.h"
#include "cli/row_journal.h"
#include "cli/study_shapes.h"

namespace mimicry::cli {
namespace {

using Json = nlohmann::ordered_json;

struct ReplayArguments {
  std::vector<std::string> strokes;
  std::vector<std::string> techniques;
  std::string shapes;
  std::string mesh;
  std::string targets;
  std::string out;
  std::string misses = "connect";
  int threads = 0;
};

// What decides the rows: an interrupted run is only taken up by the same. Also the file
// replay.json.
nlohmann::ordered_json settings_of(const ReplayArguments& args) {
  namespace fs = std::filesystem;
  const auto absolute = [](const std::string& path) {
    return path.empty() ? path : fs::absolute(path).lexically_normal().string();
  };
  Json strokes = Json::array(), bytes = Json::array();
  for (const std::string& path : args.strokes) {
    std::error_code none;
    const auto size = fs::file_size(path, none);
    strokes.push_back(absolute(path));
    bytes.push_back(none ? 0 : size);
  }
  return {{"version", MIMICRY_VERSION},
          {"strokes", strokes},
          {"bytes", bytes},
          {"techniques", args.techniques},
          {"shapes", absolute(args.shapes)},
          {"mesh", fs::exists(args.mesh) ? absolute(args.mesh) : args.mesh},
          {"targets", absolute(args.targets)},
          {"misses", args.misses}};
}

void run_replay(const ReplayArguments& args, int& status) {
  ReplayOptions options;
  for (const std::string& name : args.techniques)
    options.techniques.push_back(&technique::find_technique(name));
  options.shapes = args.shapes;
  options.targets = args.targets;
  options.mesh = args.mesh;
  options.misses =
      args.misses == "split" ? session::MissPolicy::split : session::MissPolicy::connect;
  const Replayer replayer(options);
  ReplaySource source(args.strokes);
  const nlohmann::ordered_json settings = settings_of(args);
  RowJournal journal(args.out, json_text(settings, -1), io::csv_heading(replay_columns()));
  // Where it lies, so that the report of a study that was moved as a whole finds its strokes.
  nlohmann::ordered_json kept = settings;
  kept["folder"] = std::filesystem::absolute(args.out).lexically_normal().string();
  files::write_file_atomically((std::filesystem::path(args.out) / "replay.json").string(),
                               json_text(kept) + "\n");

  // Jobs that were finished before the interruption.
  std::size_t job = 0;
  for (; job < journal.jobs(); ++job)
    if (!source.next()) break;
  if (journal.jobs() > 0)
    complain(args.out + ": " + std::to_string(journal.rows()) +
             " rows are there already; the rest follows");

  ProgressLine progress("replaying");
  const int threads = thread_count(args.threads);
  // Results are small; a slow stroke must not make the others wait.
  const std::size_t most_ahead = 64 * static_cast<std::size_t>(threads);
  work_in_order(
      threads, most_ahead, [&] { return source.next(); },
      [&](const ReplayJob& next) { return replayer.run(next); },
      [&](const ReplayRows& rows) {
        end_if_requested();
        for (const std::string& reason : rows.reasons) complain("rejected: " + reason);
        journal.append(rows.csv, rows.json_lines, rows.rows, rows.rejected);
        progress.update(source.bytes_read(), source.bytes());
      });
  journal.record();
  std::printf("%s: %zu rows, %zu of them rejected\n", journal.csv_path().c_str(), journal.rows(),
              journal.rejected());
  if (journal.rejected() > 0 || journal.rows() == 0)
    status = journal.rejected() < journal.rows() ? kPartly : kBadInput;
}

}  // namespace

void add_replay(CLI::App& app, int& status) {
  auto* command = app.add_subcommand(
      "replay", "Draw recorded strokes again with any technique, and measure the curves");
  auto args = std::make_shared<ReplayArguments>();
  command
      ->add_option("--strokes", args->strokes,
                   "mimicry-strokes files, and folders of a study's participants")
      ->required();
  command->add_option("-t,--techniques", args->techniques, "Names (mimicry techniques)")
      ->delimiter(',')
      ->required();
  command->add_option("--shapes", args->shapes,
                      "Folder of the targets' mesh files (default: the built-in shapes)");
  command->add_option("--mesh", args->mesh,
                      std::string("All strokes were drawn on this one: ") + kMeshHelp);
  command->add_option("--targets", args->targets,
                      "Target curves; needed for participants' folders");
  command
      ->add_option("-o,--out", args->out,
                   "Folder for rows.csv and rows.jsonl; an interrupted run goes on there")
      ->required();
  command->add_option("--misses", args->misses, "Where a point is undefined: connect or split")
      ->check(CLI::IsMember({"connect", "split"}))
      ->capture_default_str();
  add_threads_option(*command, args->threads);
  command->callback([args, &status] { run_replay(*args, status); });
}

}  // namespace mimicry::cli
