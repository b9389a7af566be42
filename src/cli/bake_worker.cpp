#include <cerrno>
#include <csignal>
#include <cstdint>
#include <memory>
#include <new>
#include <string>
#include <string_view>
#include <system_error>

#include <nlohmann/json.hpp>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <mimicry/bake/bake.h>
#include <mimicry/base/error.h>
#include <mimicry/io/embedding_file.h>
#include <mimicry/io/meshes.h>
#include <mimicry/mesh/connect.h>

#include "assets/bake_cache.h"
#include "cli/commands.h"

namespace mimicry::cli {
namespace {

constexpr int kMesh = 0, kMessages = 1, kResult = 3;

struct WorkerArguments {
  std::string name, keep;
  std::uint64_t keep_bytes = 0, result_bytes = 0, memory = 0, cpu_s = 0;
  std::size_t faces = 0;
  int threads = 1;
};

bool write_all(int file, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t count = ::write(file, bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(count));
  }
  return true;
}

void tell(const nlohmann::json& message) {
  (void)write_all(kMessages,
                  message.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
}

void limit(int resource, std::uint64_t value) {
  const rlimit both{value, value};
  (void)setrlimit(static_cast<__rlimit_resource_t>(resource), &both);
}

void take_limits(const WorkerArguments& args) {
  // The server's end is this one's, however it came.
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (nice(5) == -1) errno = 0;  // requests go first
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_CPU, args.cpu_s);
  limit(RLIMIT_FSIZE, args.result_bytes);
  std::signal(SIGXFSZ, SIG_IGN);    // writing fails instead
#if !defined(__SANITIZE_ADDRESS__)  // which takes terabytes of addresses
  limit(RLIMIT_AS, args.memory);
#endif
}

std::string_view mesh_bytes() {
  struct stat status = {};
  if (::fstat(kMesh, &status) != 0 || status.st_size == 0) return {};
  const auto size = static_cast<std::size_t>(status.st_size);
  void* const at = ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE, kMesh, 0);
  if (at == MAP_FAILED) throw std::bad_alloc();
  return {static_cast<const char*>(at), size};
}

Embedding baked(const WorkerArguments& args, const BakeCache& kept, bool& is_new) {
  tell({{"stage", "reading"}, {"fraction", 0.0}});
  MeshReadOptions limits;
  limits.max_faces = args.faces;
  // Kept bakes are found by the surface.
  const TriangleMesh mesh =
      connect(read_mesh(mesh_bytes(), mesh_format_of(args.name), args.name, limits)).mesh;
  const BakeOptions options;
  try {
    if (auto found = kept.find(mesh, options)) return *std::move(found);
  } catch (const Error&) {  // `keep` will say the same
  }
  is_new = true;
  return mimicry::bake(mesh, options, args.threads, [](const Progress& progress) {
    tell({{"stage", progress.stage}, {"fraction", progress.fraction}});
    return true;
  });
}

void work(const WorkerArguments& args) {
  const BakeCache kept(args.keep, args.keep_bytes);
  bool is_new = false;
  const Embedding made = baked(args, kept, is_new);
  if (!write_all(kResult, write_embedding(made))) throw std::bad_alloc();
  tell({{"done", true}});
  if (!is_new) return;
  try {
    kept.keep(made);
  } catch (const Error& error) {
    tell({{"note",
           std::string("a bake was sent but is not kept for the next time: ") + error.what()}});
  }
}

void run_worker(const WorkerArguments& args) {
  take_limits(args);
  const auto fail = [](int status, const std::string& sentence) {
    tell({{"error", sentence}, {"status", status}});
  };
  const auto too_large = [&] {
    fail(507, args.name + ": the model takes more memory than a bake may use (" +
                  std::to_string(args.memory >> 20) +
                  " MB); simplify it, or give the server more with --bake-memory-mb");
  };
  try {
    work(args);
  } catch (const Error& error) {
    fail(error.kind() == ErrorKind::io ? 500 : 422, error.what());
  } catch (const std::bad_alloc&) {
    too_large();
  } catch (const std::system_error&) {  // a thread that has no memory for its stack
    too_large();
  } catch (const std::exception& error) {
    fail(500, error.what());
  }
}

}  // namespace

void add_bake_worker(CLI::App& app, int&) {
  auto* command = app.add_subcommand("bake-worker", "What `serve` starts for each bake");
  command->group("");  // not for people
  auto args = std::make_shared<WorkerArguments>();
  command->add_option("--name", args->name)->required();
  command->add_option("--keep", args->keep)->required();
  command->add_option("--keep-bytes", args->keep_bytes)->required();
  command->add_option("--result-bytes", args->result_bytes)->required();
  command->add_option("--memory", args->memory)->required();
  command->add_option("--cpu-s", args->cpu_s)->required();
  command->add_option("--faces", args->faces)->required();
  command->add_option("--threads", args->threads)->required();
  command->callback([args] { run_worker(*args); });
}

}  // namespace mimicry::cli
