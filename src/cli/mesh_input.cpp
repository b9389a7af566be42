#include "cli/mesh_input.h"

#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <utility>

#include <mimicry/base/error.h>
#include <mimicry/files/beside.h>
#include <mimicry/files/file.h>
#include <mimicry/io/mesh_reader.h>
#include <mimicry/io/number.h>
#include <mimicry/mesh/connect.h>
#include <mimicry/mesh/shapes.h>

#include "cli/commands.h"
#include "cli/console.h"
#include "cli/embedding_input.h"

namespace mimicry::cli {
namespace {

constexpr std::string_view kShapePrefix = "shape:";
constexpr double kShownDiagonal_m = 0.6;

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

io::MeshReadOptions read_options(const std::string& path, const std::string& name) {
  io::MeshReadOptions options;
  options.companion = [path](const std::string& beside) {
    return files::read_beside(path, beside);
  };
  options.note = [name](const std::string& sentence) { complain(name + ": " + sentence); };
  options.raises_unfolded = "MIMICRY_MAX_UNFOLDED in the environment";
  if (const char* text = std::getenv("MIMICRY_MAX_UNFOLDED")) {
    const auto limit = io::parse_double(text);
    if (!limit || !(*limit >= 0.0 && *limit < 1e15))
      throw Error(ErrorKind::invalid_input,
                  std::string("MIMICRY_MAX_UNFOLDED: '") + text + "' is not a number of triangles");
    options.max_unfolded = static_cast<std::size_t>(*limit);
  }
  return options;
}

// The surface of a bake is taken as it is. Of one that was made with --no-join it is said what an
// unjoined mesh is told of.
TriangleMesh load_baked_surface(const std::string& spec, const std::string& name) {
  TriangleMesh mesh = mesh_of(load_embedding(spec));
  const TriangleMesh by_number({mesh.positions().begin(), mesh.positions().end()},
                               {mesh.faces().begin(), mesh.faces().end()});
  ConnectReport open;
  open.seam_edges = connect(by_number).report.joined_edges;
  for (const std::string& sentence : open.sentences()) complain(name + ": " + sentence);
  return mesh;
}

}  // namespace

CLI::Validator number_between(double lowest, double highest) {
  const std::string range = io::format_double(lowest) + " to " + io::format_double(highest);
  return CLI::Validator(
      [=](std::string& text) -> std::string {
        const auto value = io::parse_double(text);
        if (value && std::isfinite(*value) && *value >= lowest && *value <= highest) return "";
        return "'" + text + "' is not a number from " + range;
      },
      range);
}

NamedMesh load_mesh(const std::string& spec) {
  if (spec.starts_with(kShapePrefix)) return load_shape(spec);
  const std::string name = std::filesystem::path(spec).filename().string();
  TriangleMesh mesh = is_embedding_file(spec)
                          ? load_baked_surface(spec, name)
                          : io::read_mesh(files::read_file(spec), io::mesh_format_of(spec), name,
                                          read_options(spec, name));
  const double size = diagonal(mesh);
  return {name, std::move(mesh), size > 0.0 ? kShownDiagonal_m / size : 1.0};
}

std::string find_mesh_file(const std::string& folder, const std::string& name) {
  for (const char* extension : {".obj", ".ply", ".stl", ".off", ".glb", ".gltf"}) {
    const auto path = std::filesystem::path(folder) / (name + extension);
    if (std::filesystem::is_regular_file(path)) return path.string();
  }
  throw Error(ErrorKind::io,
              folder + ": has no mesh " + name + ".obj (nor .ply, .stl, .off, .glb, .gltf)");
}

void add_target_options(CLI::App& command, spatial::TargetOptions& options) {
  command.add_flag("!--no-join", options.join,
                   "Leave vertices at one position apart: curves stop at seams");
  command.add_flag("--strict", options.strict,
                   "Refuse a mesh with flaws (edges of three or more faces, faces twice or turned "
                   "...) rather than draw on what it is meant to be");
  command
      .add_flag_callback(
          "--allow-nonmanifold",
          [] { complain("--allow-nonmanifold is no longer needed: every mesh can be drawn on"); })
      ->group("");
}

spatial::Target make_target_silently(const NamedMesh& named,
                                     const spatial::TargetOptions& options) {
  try {
    return spatial::Target(named.mesh, options);
  } catch (const Error& error) {
    throw Error(error.kind(), named.name + ": " + error.what());
  }
}

spatial::Target make_target(const NamedMesh& named, const spatial::TargetOptions& options) {
  spatial::Target target = make_target_silently(named, options);
  for (const std::string& sentence : target.connection().sentences())
    complain(named.name + ": " + sentence);
  return target;
}

}  // namespace mimicry::cli
