#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>

#include <mimicry/assets/canvas.h>
#include <mimicry/base/error.h>
#include <mimicry/io/embedding_file.h>

#include "assets/bakes.h"
#include "bake/quality.h"
#include "cli/commands.h"
#include "cli/console.h"
#include "cli/options.h"
#include "files/file.h"
#include "files/names.h"
#include "io/embedding_text.h"

namespace mimicry::cli {
namespace {

// Text files give some 6 digits or more.
constexpr double kRounding = 1e-4;

struct ImportEmbeddingArguments {
  std::string surface, shell, mesh, out;
};

EmbeddingText read(const std::string& file, int corners) {
  return read_embedding_text(read_file(file), file_name(file), corners);
}

// The vertices' places as the mesh's own file has them, so that the embedding is that mesh's.
void take_positions(Embedding& e, const NamedMesh& named) {
  const auto refuse = [&](const std::string& what) {
    throw Error(ErrorKind::invalid_input,
                named.name + ": " + what + "; give the mesh that the embedding was made of");
  };
  if (named.mesh.vertex_count() != e.mesh_vertex_count ||
      !std::equal(e.faces.begin(), e.faces.end(), named.mesh.faces().begin(),
                  named.mesh.faces().end()))
    refuse("its vertices or faces are not those of the surface's file");
  for (Index v = 0; v < e.mesh_vertex_count; ++v) {
    Vec3& p = e.positions[static_cast<std::size_t>(v)];
    if (!((p - named.mesh.position(v)).norm() <= kRounding * e.diagonal))
      refuse("vertex " + std::to_string(v) + " stands elsewhere than in the surface's file");
    p = named.mesh.position(v);
  }
  e.mesh_hash = content_hash(named.mesh);
  e.diagonal = diagonal(named.mesh);
}

void run_import_embedding(const ImportEmbeddingArguments& args) {
  Embedding e = make_embedding(read(args.surface, 3), read(args.shell, 4));
  if (!args.mesh.empty()) take_positions(e, load_mesh(args.mesh, terminal_monitor()));
  const Eigen::Map<const Values> values(e.values.data(), e.vertex_count(), e.dimension);
  e.quality.sliver_percent = sliver_percent(e.tets, values);
  // All that is refused is refused before the file is written.
  make_projector(e, file_name(args.surface));
  write_file_atomically(args.out, write_embedding(e));
  std::printf("%s: %d vertices, %d faces; shell of %d vertices, %zu tetrahedra; slivers %s %%\n",
              args.out.c_str(), e.mesh_vertex_count, e.face_count(), e.vertex_count(),
              e.tets.size(), fixed(e.quality.sliver_percent, 2).c_str());
}

}  // namespace

void add_import_embedding(CLI::App& app, int&) {
  auto* command = app.add_subcommand(
      "import-embedding", "Make a .mimicry file of an embedding in the text format of other tools");
  auto args = std::make_shared<ImportEmbeddingArguments>();
  command->add_option("surface", args->surface, "The text file of the triangles (TRI.txt)")
      ->required();
  command->add_option("shell", args->shell, "The text file of the tetrahedra (TET.txt)")
      ->required();
  command->add_option("--mesh", args->mesh,
                      "The mesh that it was made of: its digits are kept, so that the result fits "
                      "this file; " +
                          std::string(kMeshHelp));
  command->add_option("-o,--out", args->out, "The .mimicry file to write")->required();
  command->callback([args] { run_import_embedding(*args); });
}

}  // namespace mimicry::cli
