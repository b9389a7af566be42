#pragma once

#include <string>

#include <mimicry/assets/canvas.h>

namespace mimicry {

/// The mesh file of this name in a folder, whatever its kind. Throws Error(io) where there is none.
std::string find_mesh_file(const std::string& folder, const std::string& name);

/// What load_mesh takes for the shape of this name: a file of the folder (by its own name, or with
/// the ending of a mesh), or a built-in shape where there is no folder. Throws Error(io).
std::string mesh_spec(const std::string& folder, const std::string& shape);

}  // namespace mimicry
