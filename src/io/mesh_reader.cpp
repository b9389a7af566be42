#include <string>
#include <utility>

#include <mimicry/base/error.h>
#include <mimicry/io/meshes.h>

#include "base/float_traps.h"
#include "io/mesh_builder.h"
#include "io/text.h"

namespace mimicry {

namespace {

constexpr std::pair<std::string_view, MeshFormat> kEndings[] = {
    {"obj", MeshFormat::obj}, {"ply", MeshFormat::ply}, {"stl", MeshFormat::stl},
    {"off", MeshFormat::off}, {"glb", MeshFormat::glb}, {"gltf", MeshFormat::gltf}};

std::optional<MeshFormat> format_of(std::string_view file_name) {
  const std::size_t dot = file_name.rfind('.');
  if (dot == std::string_view::npos) return std::nullopt;
  const std::string ending = to_lower(file_name.substr(dot + 1));
  for (const auto& [name, format] : kEndings)
    if (ending == name) return format;
  return std::nullopt;
}

}  // namespace

MeshFormat mesh_format_of(std::string_view file_name) {
  if (const auto format = format_of(file_name)) return *format;
  throw Error(ErrorKind::unsupported,
              std::string(file_name) +
                  ": the name does not end in a mesh format's; use .obj, .ply, .stl, .off, .glb or "
                  ".gltf");
}

bool is_mesh_name(std::string_view file_name) {
  return format_of(file_name).has_value();
}

TriangleMesh read_mesh(std::string_view bytes, MeshFormat format, std::string_view name,
                       const MeshReadOptions& options) {
  // A file may hold any bits: signalling NaN, numbers that overflow.
  const FloatTrapMask mask;
  MeshBuilder mesh(name, options);
  if (bytes.empty())
    throw Error(ErrorKind::invalid_input,
                std::string(name) + ": the file is empty; export it again");
  const std::string_view text = format == MeshFormat::stl ? bytes : text_of(bytes, name);
  switch (format) {
    case MeshFormat::obj:
      read_obj(text, mesh);
      break;
    case MeshFormat::ply:
      read_ply(text, mesh);
      break;
    case MeshFormat::stl:
      read_stl(text, mesh);
      break;
    case MeshFormat::off:
      read_off(text, mesh);
      break;
    case MeshFormat::glb:
    case MeshFormat::gltf:
      read_gltf(text, mesh);
      break;
  }
  if (mesh.face_count() == 0)
    throw Error(ErrorKind::invalid_input,
                std::string(name) + ": holds no triangle or polygon (" +
                    std::to_string(mesh.vertex_count()) +
                    " vertices); give a surface mesh of the format that the name stands for");
  return mesh.finish();
}

}  // namespace mimicry
