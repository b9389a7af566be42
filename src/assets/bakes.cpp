#include "assets/bakes.h"

#include <filesystem>
#include <utility>

#include <mimicry/bake/bake.h>
#include <mimicry/base/error.h>
#include <mimicry/io/embedding_file.h>

#include "assets/bake_cache.h"
#include "assets/work.h"
#include "files/file.h"
#include "files/names.h"

namespace mimicry {

Baked bake_mesh(const TriangleMesh& mesh, const BakeSettings& settings, const Monitor& monitor,
                const ProgressCallback& stages) {
  const BakeCache cache = settings.use_cache ? BakeCache::of_user() : BakeCache();
  if (auto kept = cache.find(mesh, settings.options)) return {std::move(*kept), true};
  Baked baked;
  baked.embedding = mimicry::bake(
      mesh, settings.options, thread_count(settings.threads), [&](const Progress& now) {
        monitor.report("baking", static_cast<std::size_t>(100 * now.fraction), 100);
        return !stages || stages(now);
      });
  try {
    cache.keep(baked.embedding);
  } catch (const Error& error) {
    monitor.tell("the bake is not kept for the next time: " + std::string(error.what()));
  }
  return baked;
}

Embedding load_embedding(const std::string& file) {
  return read_embedding(MappedFile(file).bytes(), file_name(file));
}

bool is_embedding_file(const std::string& spec) {
  return to_path(spec).extension() == ".mimicry";
}

SmoothProjector make_projector(Embedding embedding, const std::string& name) {
  try {
    const Target target(mesh_of(embedding));
    return {std::move(embedding), target};
  } catch (const Error& error) {
    throw Error(error.kind(), name + ": " + error.what());
  }
}

}  // namespace mimicry
