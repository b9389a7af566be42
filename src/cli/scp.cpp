#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

#include <mimicry/assets/canvas.h>
#include <mimicry/base/error.h>
#include <mimicry/io/strokes.h>

#include "assets/bakes.h"
#include "assets/work.h"
#include "cli/commands.h"
#include "cli/interrupt.h"
#include "cli/options.h"
#include "files/file.h"
#include "files/names.h"

namespace mimicry::cli {
namespace {

constexpr std::size_t kChunk = 1024;

struct ScpArguments {
  std::string embedding, points, out;
  bool replace_failed = false;
  int threads = 0;
};

void run_scp(const ScpArguments& args, int& status) {
  const std::string points_name = file_name(args.points);
  std::error_code unknown;  // of a file that does not exist
  if (std::filesystem::equivalent(to_path(args.points), to_path(args.out), unknown))
    throw Error(ErrorKind::invalid_input,
                args.out + ": is what --points names, and would be lost; give another --out");
  const PointRows rows = read_points_csv(read_file(args.points), points_name);
  const SmoothProjector projector =
      make_projector(load_embedding(args.embedding), file_name(args.embedding));

  std::vector<std::optional<SmoothPoint>> answers(rows.points.size());
  Executor executor(thread_count(args.threads));
  executor.for_chunks(answers.size(), kChunk, [&](std::size_t begin, std::size_t end, int) {
    ScpHint hint;
    for (std::size_t i = begin; i < end; ++i)
      answers[i] =
          projector.project(rows.points[i], {.replace_failed = args.replace_failed}, &hint);
  });
  write_file_atomically(args.out, write_smooth_points_csv(answers));

  std::size_t smooth = 0, undefined = 0, first = 0;
  for (std::size_t i = 0; i < answers.size(); ++i) {
    if (!answers[i] && undefined++ == 0) first = i;
    if (answers[i] && answers[i]->label == ScpLabel::smooth) ++smooth;
  }
  std::printf("%s: %zu points, %zu smooth, %zu closest points instead\n", args.out.c_str(),
              answers.size(), smooth, answers.size() - smooth - undefined);
  if (undefined == 0) return;
  std::fprintf(
      stderr,
      "mimicry: %s: %zu points are not finite or beyond 1e60 (first: line %zu); their rows "
      "say not-finite\n",
      points_name.c_str(), undefined, rows.lines[first]);
  status = kPartly;
}

}  // namespace

void add_scp(CLI::App& app, int& status) {
  auto* command = app.add_subcommand("scp", "Smooth closest points of many points");
  auto args = std::make_shared<ScpArguments>();
  command->add_option("--embedding", args->embedding, "The target's bake (mimicry bake)")
      ->required();
  command->add_option("--points", args->points, "A CSV file with columns x, y, z, in mesh units")
      ->required();
  command
      ->add_option("-o,--out", args->out,
                   "The CSV file to write: face,b0,b1,b2,x,y,z,label, a row a point")
      ->required();
  command->add_flag(
      "--replace-failed", args->replace_failed,
      "The closest point where the smooth one is a twentieth of the diagonal farther");
  add_threads_option(*command, args->threads);
  command->callback([args, &status] { run_scp(*args, status); });
}

}  // namespace mimicry::cli
