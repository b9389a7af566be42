// Time and peak memory of bakes of meshes that defy the shell, each in a process of its own:
//   bake_budget_bench [FAMILY, FILE.off or "shapes"] [FACES ...] (all families, 10 to 20,000 faces)
// The budget: 20 s and 0.5 ms a face on two threads; 300 MB and 10 kB a face.

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <mimicry/bake/bake.h>
#include <mimicry/io/meshes.h>
#include <mimicry/mesh/shapes.h>

#include "files/file.h"
#include "messy/messy_meshes.h"

namespace mimicry {
namespace {

using Clock = std::chrono::steady_clock;
constexpr unsigned kGiveUpSeconds = 180;

// What the child tells.
struct Told {
  bool is_done = false;
  Index tets = 0;
  BakeQuality quality;
};

Told bake_in_child(const TriangleMesh& mesh, int pipe_end) {
  Told told;
  try {
    const Embedding e = bake(mesh, {}, 2);
    told.is_done = true;
    told.tets = static_cast<Index>(e.tets.size());
    told.quality = e.quality;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
  }
  if (write(pipe_end, &told, sizeof told) != static_cast<ssize_t>(sizeof told)) std::_Exit(1);
  return told;
}

bool measure(const std::string& name, const TriangleMesh& mesh) {
  int ends[2];
  if (pipe(ends) != 0) return false;
  std::fflush(stdout);
  const auto start = Clock::now();
  const pid_t child = fork();
  if (child == 0) {
    alarm(kGiveUpSeconds);
    bake_in_child(mesh, ends[1]);
    std::_Exit(0);
  }
  close(ends[1]);
  Told told;
  const bool is_told = read(ends[0], &told, sizeof told) == static_cast<ssize_t>(sizeof told);
  close(ends[0]);
  rusage use{};
  int status = 0;
  wait4(child, &status, 0, &use);
  const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
  const double work = static_cast<double>(use.ru_utime.tv_sec + use.ru_stime.tv_sec) +
                      1e-6 * static_cast<double>(use.ru_utime.tv_usec + use.ru_stime.tv_usec);
  const double memory = static_cast<double>(use.ru_maxrss) / 1024.0;
  const double most_seconds = 20.0 + 0.5e-3 * mesh.face_count();
  const double most_memory = 300.0 + 10e-3 * mesh.face_count();
  const BakeQuality& q = told.quality;
  const bool is_good = is_told && seconds < most_seconds && memory < most_memory;
  std::printf("| %s | %d | %.2f | %.2f | %.0f | %d | %s | %d | %d | %d | %d | %d |%s\n",
              name.c_str(), mesh.face_count(), seconds, work, memory, told.tets,
              !is_told        ? "stopped"
              : !told.is_done ? "refused"
              : q.is_lattice  ? "lattice"
                              : "shell",
              q.shell_rounds, q.added_vertices, q.missing_edges + q.pierced_faces, q.crossing_faces,
              q.ls_mesh_iterations, is_good ? "" : " over the budget");
  return is_good;
}

int run(int argc, char** argv) {
  const std::string which = argc > 1 ? argv[1] : "all";
  std::vector<Index> sizes;
  for (int k = 2; k < argc; ++k) sizes.push_back(std::atoi(argv[k]));
  if (sizes.empty()) sizes = {10, 100, 1000, 4000, 20000};
  std::printf(
      "| mesh | faces | s | CPU s | MB | tetrahedra | shell | rounds | added | missing | crossing "
      "| "
      "iterations |\n| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |\n");
  bool all_good = true;
  if (which.ends_with(".off")) {
    all_good = measure(which, read_mesh(read_file(which), MeshFormat::off, which));
  } else if (which == "shapes") {
    for (const ShapeInfo& shape : builtin_shapes())
      all_good = measure(std::string(shape.name), make_shape(shape.name)) && all_good;
  } else {
    for (const messy::Family& family : messy::families())
      if (which == "all" || which == family.name)
        for (const Index faces : sizes)
          all_good = measure(std::string(family.name), family.make(faces, 1)) && all_good;
  }
  return all_good ? 0 : 1;
}

}  // namespace
}  // namespace mimicry

int main(int argc, char** argv) {
  return mimicry::run(argc, argv);
}
