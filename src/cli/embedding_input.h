#pragma once

#include <memory>
#include <string>

#include <CLI/CLI.hpp>

#include <mimicry/base/parallel.h>
#include <mimicry/embedding/smooth_projector.h>

namespace mimicry::cli {

/// How a command bakes.
struct BakeSettings {
  embedding::BakeOptions options;
  int threads = 0;  ///< 0: as many as the machine has
  bool use_cache = true;
};

/// --threads.
void add_threads_option(CLI::App& command, int& threads);
/// --no-cache.
void add_cache_option(CLI::App& command, BakeSettings& settings);
/// `threads`, or as many as the machine has for 0; never more than kMostThreads.
int thread_count(int threads);

struct Baked {
  embedding::Embedding embedding;
  bool was_kept = false;  ///< from an earlier bake
};

/// The bake of a mesh: an earlier one of the same mesh and options, or a new one, which is kept.
/// progress hears of a new one. Ctrl-C throws Error(cancelled) and leaves nothing behind.
Baked bake_mesh(const TriangleMesh& mesh, const BakeSettings& settings,
                const ProgressCallback& progress = {});

/// Throws Error, which begins with the file's name, where it is not a sound .mimicry file.
embedding::Embedding load_embedding(const std::string& file);

/// Whether a name on the command line is that of a .mimicry file.
bool is_embedding_file(const std::string& spec);

/// An embedding and what it needs to answer queries. Errors begin with `name`.
class LoadedProjector {
 public:
  /// On the mesh in the embedding.
  LoadedProjector(embedding::Embedding embedding, const std::string& name);
  const embedding::SmoothProjector& operator*() const { return *projector_; }
  const embedding::SmoothProjector* operator->() const { return projector_.get(); }

 private:
  std::unique_ptr<spatial::Target> target_;
  std::unique_ptr<embedding::SmoothProjector> projector_;
};

}  // namespace mimicry::cli
