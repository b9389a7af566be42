#include "cli/embedding_input.h"

#include <algorithm>
#include <filesystem>
#include <thread>
#include <utility>

#include <mimicry/bake/bake.h>
#include <mimicry/base/error.h>
#include <mimicry/files/file.h>
#include <mimicry/io/embedding_file.h>

#include "cli/bake_cache.h"
#include "cli/console.h"

namespace mimicry::cli {

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

int thread_count(int threads) {
  const int hardware = static_cast<int>(std::thread::hardware_concurrency());
  return std::clamp(threads > 0 ? threads : hardware, 1, kMostThreads);
}

Baked bake_mesh(const TriangleMesh& mesh, const BakeSettings& settings,
                const ProgressCallback& progress) {
  const BakeCache cache = settings.use_cache ? BakeCache::of_user() : BakeCache();
  if (auto kept = cache.find(mesh, settings.options)) return {std::move(*kept), true};
  ProgressLine line("baking");
  Baked baked;
  baked.embedding =
      bake::bake(mesh, settings.options, thread_count(settings.threads), [&](const Progress& now) {
        line.update(static_cast<std::size_t>(100 * now.fraction), 100);
        return !progress || progress(now);
      });
  cache.keep(baked.embedding);
  return baked;
}

embedding::Embedding load_embedding(const std::string& file) {
  return io::read_embedding(files::MappedFile(file).bytes(),
                            std::filesystem::path(file).filename().string());
}

bool is_embedding_file(const std::string& spec) {
  return std::filesystem::path(spec).extension() == ".mimicry";
}

LoadedProjector::LoadedProjector(embedding::Embedding embedding, const std::string& name) {
  try {
    target_ = std::make_unique<spatial::Target>(mesh_of(embedding));
    projector_ = std::make_unique<embedding::SmoothProjector>(std::move(embedding), *target_);
  } catch (const Error& error) {
    throw Error(error.kind(), name + ": " + error.what());
  }
}

}  // namespace mimicry::cli
