#include <cstdio>
#include <memory>
#include <string>

#include <nlohmann/json.hpp>

#include <mimicry/base/error.h>
#include <mimicry/io/meshes.h>
#include <mimicry/mesh/shapes.h>

#include "cli/commands.h"
#include "cli/console.h"
#include "files/file.h"

namespace mimicry::cli {
namespace {

using Json = nlohmann::ordered_json;

struct ShapesArguments {
  std::string name;
  std::string out;
  ShapeOptions options;
  bool json = false;
};

void list_shapes(bool json) {
  Json list = Json::array();
  std::vector<std::vector<std::string>> rows;
  for (const ShapeInfo& s : builtin_shapes()) {
    list.push_back({{"name", s.name},
                    {"description", s.description},
                    {"resolution", s.resolution},
                    {"default_resolution", s.default_resolution},
                    {"least_resolution", s.least_resolution},
                    {"most_resolution", s.most_resolution},
                    {"metres_per_unit", s.metres_per_unit}});
    rows.push_back({std::string(s.name), std::to_string(s.default_resolution),
                    std::to_string(s.least_resolution) + ".." + std::to_string(s.most_resolution),
                    std::string(s.description) + "; resolution: " + std::string(s.resolution)});
  }
  if (json)
    std::printf("%s\n", json_text(list).c_str());
  else
    print_table({"shape", "resolution", "range", ""}, rows);
}

void run_shapes(const ShapesArguments& args) {
  if (args.name.empty()) return list_shapes(args.json);
  if (args.out.empty())
    throw Error(ErrorKind::invalid_input, "shapes " + args.name + ": where to? give --out FILE");
  const MeshFormat format = mesh_format_of(args.out);
  const TriangleMesh mesh = make_shape(args.name, args.options);
  write_file_atomically(args.out, write_mesh(mesh, format));
  std::printf("%s: %d vertices, %d faces\n", args.out.c_str(), mesh.vertex_count(),
              mesh.face_count());
}

}  // namespace

void add_shapes(CLI::App& app, int&) {
  auto* command = app.add_subcommand("shapes", "List the built-in shapes, or write one to a file");
  auto args = std::make_shared<ShapesArguments>();
  command->add_option("name", args->name, "The shape; all are listed without it");
  command->add_option("--resolution", args->options.resolution, "0: the shape's default");
  command->add_option("--seed", args->options.seed, "Of the random shapes");
  command->add_option("--noise", args->options.noise,
                      "noisy-cube: largest displacement, part of the cube's edge");
  command->add_flag("--two-sided", args->options.two_sided, "noisy-cube: displace both ways");
  command->add_option("-o,--out", args->out, "File to write; its ending says the format");
  command->add_flag("--json", args->json, "The list for programs");
  command->callback([args] { run_shapes(*args); });
}

}  // namespace mimicry::cli
