#include "assets/meshes.h"

#include <charconv>
#include <cstdlib>
#include <filesystem>
#include <utility>

#include <mimicry/base/error.h>
#include <mimicry/io/meshes.h>
#include <mimicry/mesh/connect.h>
#include <mimicry/mesh/shapes.h>

#include "assets/bakes.h"
#include "files/beside.h"
#include "files/environment.h"
#include "files/file.h"
#include "files/names.h"
#include "io/number.h"
#include "mesh/shown_size.h"

namespace mimicry {
namespace {

constexpr std::string_view kShapePrefix = "shape:";

NamedMesh load_shape(const std::string& spec) {
  const std::string rest = spec.substr(kShapePrefix.size());
  const std::size_t colon = rest.find(':');
  const std::string name = rest.substr(0, colon);
  ShapeOptions options;
  if (colon != std::string::npos) {
    const std::string digits = rest.substr(colon + 1);
    const auto [end, fault] =
        std::from_chars(digits.data(), digits.data() + digits.size(), options.resolution);
    if (fault != std::errc() || end != digits.data() + digits.size())
      throw Error(ErrorKind::invalid_input,
                  spec + ": '" + digits + "' is not a resolution; write shape:torus:48");
  }
  TriangleMesh mesh = make_shape(name, options);
  return {name, std::move(mesh), find_shape(name)->metres_per_unit};
}

MeshReadOptions read_options(const std::string& path, const std::string& name,
                             const Monitor& monitor) {
  MeshReadOptions options;
  options.companion = [path](const std::string& beside) { return read_beside(path, beside); };
  options.note = [name, &monitor](const std::string& sentence) {
    monitor.tell(name + ": " + sentence);
  };
  options.raises_unfolded = "MIMICRY_MAX_UNFOLDED in the environment";
  if (const auto text = environment("MIMICRY_MAX_UNFOLDED")) {
    const auto limit = parse_double(*text);
    if (!limit || !(*limit >= 0.0 && *limit < 1e15))
      throw Error(ErrorKind::invalid_input,
                  "MIMICRY_MAX_UNFOLDED: '" + *text + "' is not a number of triangles");
    options.max_unfolded = static_cast<std::size_t>(*limit);
  }
  return options;
}

// The surface of a bake is taken as it is. Of one that was made with --no-join it is said what an
// unjoined mesh is told of.
TriangleMesh load_baked_surface(const std::string& spec, const std::string& name,
                                const Monitor& monitor) {
  TriangleMesh mesh = mesh_of(load_embedding(spec));
  const TriangleMesh by_number({mesh.positions().begin(), mesh.positions().end()},
                               {mesh.faces().begin(), mesh.faces().end()});
  ConnectReport open;
  open.seam_edges = connect(by_number).report.joined_edges;
  for (const std::string& sentence : open.sentences()) monitor.tell(name + ": " + sentence);
  return mesh;
}

}  // namespace

NamedMesh load_mesh(const std::string& spec, const Monitor& monitor) {
  if (spec.starts_with(kShapePrefix)) return load_shape(spec);
  const std::string name = file_name(spec);
  TriangleMesh mesh = is_embedding_file(spec) ? load_baked_surface(spec, name, monitor)
                                              : read_mesh(read_file(spec), mesh_format_of(spec),
                                                          name, read_options(spec, name, monitor));
  const double metres_per_unit = shown_metres_per_unit(mesh);
  return {name, std::move(mesh), metres_per_unit};
}

std::string find_mesh_file(const std::string& folder, const std::string& name) {
  for (const char* extension : {".obj", ".ply", ".stl", ".off", ".glb", ".gltf"}) {
    std::string path = join_path(folder, name + extension);
    if (std::filesystem::is_regular_file(status_of(path))) return path;
  }
  throw Error(ErrorKind::io,
              folder + ": has no mesh " + name + ".obj (nor .ply, .stl, .off, .glb, .gltf)");
}

std::string mesh_spec(const std::string& folder, const std::string& shape) {
  if (folder.empty()) return std::string(kShapePrefix) + shape;
  std::error_code none;
  std::string file = join_path(folder, shape);
  if (std::filesystem::is_regular_file(to_path(file), none)) return file;
  return find_mesh_file(folder, shape);
}

Target make_target(const NamedMesh& named, const TargetOptions& options, const Monitor& monitor) {
  try {
    Target target(named.mesh, options);
    for (const std::string& sentence : target.connection().sentences())
      monitor.tell(named.name + ": " + sentence);
    return target;
  } catch (const Error& error) {
    throw Error(error.kind(), named.name + ": " + error.what());
  }
}

Target load_target(const std::string& spec, const Monitor& monitor) {
  return make_target(load_mesh(spec, monitor), {}, monitor);
}

}  // namespace mimicry
