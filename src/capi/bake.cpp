#include <mimicry/bake/bake.h>
#include <mimicry/io/embedding_file.h>

#include "capi/handles.h"

using namespace mimicry;
using namespace mimicry::capi;

mimicry_bake_options mimicry_default_bake_options(void) {
  const BakeOptions defaults;
  return {defaults.dimension, defaults.samples, defaults.offset, 1, 0};
}

mimicry_status mimicry_bake(const mimicry_mesh* mesh, const mimicry_bake_options* options,
                            mimicry_progress progress, void* user, mimicry_bytes** out) {
  return made(out, [&] {
    require(mesh, "mesh");
    const mimicry_bake_options o = options ? *options : mimicry_default_bake_options();
    if (o.dimension < 3 || o.dimension > 8)
      throw Error(ErrorKind::invalid_input, "an embedding of " + std::to_string(o.dimension) +
                                                " dimensions; 3 to 8 are possible");
    if (o.threads > kMostThreads)
      throw Error(ErrorKind::invalid_input, std::to_string(o.threads) + " threads; at most " +
                                                std::to_string(kMostThreads) + " are possible");
    return mimicry_bytes{write_embedding(mimicry::bake(
        mesh->mesh, {o.dimension, o.samples, o.offset}, o.threads, to_callback(progress, user)))};
  });
}
