#include <chrono>
#include <cstdio>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <mimicry/assets/canvas.h>
#include <mimicry/io/embedding_file.h>

#include "cli/commands.h"
#include "cli/console.h"
#include "cli/options.h"
#include "files/file.h"
#include "files/output_lock.h"

namespace mimicry::cli {
namespace {

struct BakeArguments {
  std::string mesh;
  std::string out;
  BakeSettings bake;
  TargetOptions target;
};

// Time of each stage, from the progress reports: the library itself looks at no clock.
class StageTimes {
 public:
  void enter(std::string_view stage) {
    if (!stages_.empty() && stages_.back().first == stage) return;
    stages_.emplace_back(stage, Clock::now());
  }
  void print() const {
    for (std::size_t i = 0; i + 1 < stages_.size(); ++i)
      std::printf(
          "  %-12s %s s\n", stages_[i].first.c_str(),
          fixed(std::chrono::duration<double>(stages_[i + 1].second - stages_[i].second).count(), 2)
              .c_str());
  }

 private:
  using Clock = std::chrono::steady_clock;
  std::vector<std::pair<std::string, Clock::time_point>> stages_;
};

// Whether the mesh stands in the shell's tetrahedra, and where not, why.
std::string kind_of_shell(const BakeQuality& q) {
  if (!q.is_lattice) return "the mesh stands in it";
  std::string why = "it would take too many tetrahedra";
  if (q.missing_edges + q.pierced_faces > 0)
    why = std::to_string(q.missing_edges) + " pieces of edges and " +
          std::to_string(q.pierced_faces) + " faces are missing";
  else if (q.shell_rounds == 0 && q.crossing_faces > 0)
    why = "its edges cross " + std::to_string(q.crossing_faces) + " or more of its faces";
  return "a lattice (the mesh does not stand in it: " + why + ")";
}

void run_bake(const BakeArguments& args) {
  const auto output_lock = OutputLock::of_file(args.out);
  const NamedMesh named = load_mesh(args.mesh, terminal_monitor());
  const Target target = make_target(named, args.target, terminal_monitor());
  StageTimes times;
  const Baked baked =
      bake_mesh(target.mesh(), args.bake, terminal_monitor(), [&](const Progress& progress) {
        times.enter(progress.stage);
        return true;
      });
  const Embedding& embedding = baked.embedding;
  write_file_atomically(args.out, write_embedding(embedding));
  const BakeQuality& q = embedding.quality;
  std::printf("%s: %d vertices, %zu tetrahedra, %s\n", args.out.c_str(), embedding.vertex_count(),
              embedding.tets.size(), kind_of_shell(q).c_str());
  std::printf("  stress %s, |d/D - 1| median %s, 99 %% %s, slivers %s %%\n",
              fixed(q.stress, 4).c_str(), fixed(q.distortion[0], 4).c_str(),
              fixed(q.distortion[2], 4).c_str(), fixed(q.sliver_percent, 2).c_str());
  if (baked.was_kept) std::printf("  from an earlier bake (--no-cache makes a new one)\n");
  times.print();
}

}  // namespace

void add_bake(CLI::App& app, int&) {
  auto* command = app.add_subcommand("bake", "Prepare a target for smooth closest points");
  auto args = std::make_shared<BakeArguments>();
  command->add_option("mesh", args->mesh, kMeshHelp)->required();
  command->add_option("-o,--out", args->out, "The .mimicry file to write")->required();
  add_threads_option(*command, args->bake.threads);
  add_cache_option(*command, args->bake);
  command->add_option("--dimension", args->bake.options.dimension, "Of the embedding")
      ->check(CLI::Range(3, 8))
      ->capture_default_str();
  command->add_option("--samples", args->bake.options.samples, "At most")
      ->check(CLI::Range(10, 20000))
      ->capture_default_str();
  command
      ->add_option("--offset", args->bake.options.offset,
                   "Half the shell's thickness, part of the diagonal")
      ->check(number_between(1e-3, 0.5))
      ->capture_default_str();
  add_target_options(*command, args->target);
  command->callback([args] { run_bake(*args); });
}

}  // namespace mimicry::cli
