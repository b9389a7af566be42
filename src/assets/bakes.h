#pragma once

#include <memory>
#include <string>

#include <mimicry/base/parallel.h>
#include <mimicry/embedding/smooth_projector.h>

#include "assets/work.h"

namespace mimicry::assets {

/// How a bake that is needed is had.
struct BakeSettings {
  BakeOptions options;
  int threads = 0;  ///< 0: as many as the machine has
  bool use_cache = true;
};

struct Baked {
  Embedding embedding;
  bool was_kept = false;  ///< from an earlier bake
};

/// The bake of a mesh: an earlier one of the same mesh and options, or a new one, which is kept.
/// The monitor hears of a new one as "baking", and where it cannot be kept; `stages` hears of its
/// stages. Throws Error(cancelled) where the monitor ends it, and leaves nothing behind.
Baked bake_mesh(const TriangleMesh& mesh, const BakeSettings& settings, const Monitor& monitor = {},
                const ProgressCallback& stages = {});

/// Throws Error, which begins with the file's name, where it is not a sound .mimicry file.
Embedding load_embedding(const std::string& file);

/// Whether a name is that of a .mimicry file.
bool is_embedding_file(const std::string& spec);

/// An embedding and what it needs to answer queries. Errors begin with `name`.
class LoadedProjector {
 public:
  /// On the mesh in the embedding.
  LoadedProjector(Embedding embedding, const std::string& name);
  const SmoothProjector& operator*() const { return *projector_; }
  const SmoothProjector* operator->() const { return projector_.get(); }

 private:
  std::unique_ptr<Target> target_;
  std::unique_ptr<SmoothProjector> projector_;
};

}  // namespace mimicry::assets
