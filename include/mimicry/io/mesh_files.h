#pragma once

#include <span>
#include <string_view>

#include <mimicry/io/mesh_reader.h>

namespace mimicry {

/// A file that is held in memory. The name may begin with folders, "model/cube.gltf".
struct NamedBytes {
  std::string_view name;
  std::string_view bytes;
};

/// The number of the mesh among files: of that name, or, where `name` is empty, the only one whose
/// name ends in a mesh format's. Throws Error(invalid_input) where there is none, or more.
std::size_t mesh_among(std::span<const NamedBytes> files, std::string_view name);

/// Reads files[mesh]. What it names beside it (the buffers of a glTF) is looked for among the
/// files: by its place relative to the mesh, else the only file of that name in whatever folder.
/// `options.companion` is asked last.
TriangleMesh read_mesh_files(std::span<const NamedBytes> files, std::size_t mesh,
                             const MeshReadOptions& options = {});

}  // namespace mimicry
