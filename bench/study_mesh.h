#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include <mimicry/io/meshes.h>

#include "files/file.h"

namespace mimicry::bench {

/// A shape of the study, where its folder is present.
inline std::optional<TriangleMesh> study_mesh(const std::string& name) {
  const std::string path = MIMICRY_STUDY_DATA "/" + name + ".obj";
  if (!std::filesystem::exists(path)) return std::nullopt;
  return read_mesh(read_file(path), MeshFormat::obj, name);
}

}  // namespace mimicry::bench
