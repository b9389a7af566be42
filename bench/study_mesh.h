#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include <mimicry/files/file.h>
#include <mimicry/io/mesh_reader.h>

namespace mimicry::bench {

/// A shape of the study, where its folder is present.
inline std::optional<TriangleMesh> study_mesh(const std::string& name) {
  const std::string path = MIMICRY_STUDY_DATA "/" + name + ".obj";
  if (!std::filesystem::exists(path)) return std::nullopt;
  return io::read_mesh(files::read_file(path), io::MeshFormat::obj, name);
}

}  // namespace mimicry::bench
