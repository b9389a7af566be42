#pragma once

#include <string>

#include <mimicry/assets/canvas.h>
#include <mimicry/embedding/smooth_projector.h>

namespace mimicry {

/// Whether a name is that of a .mimicry file.
bool is_embedding_file(const std::string& spec);

/// The projector of an embedding, on the mesh in it. Errors begin with `name`.
SmoothProjector make_projector(Embedding embedding, const std::string& name);

}  // namespace mimicry
