#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace mimicry::serve {

struct ServeOptions {
  std::string studio;       ///< folder with the page; what it holds at the start is served
  std::string data_folder;  ///< of bakes and the certificate; nothing is written elsewhere
  int port = 8080;          ///< 0: any that is free
  /// Listen on all interfaces, with HTTPS (a headset gives VR to secure pages only), and not on
  /// 127.0.0.1 alone.
  bool lan = false;
  /// PEM file with a certificate and its key; with `lan` and without one a self-signed certificate
  /// with the machine's addresses is made and kept in the data folder.
  std::string certificate;
  /// Names that the server answers to beside the machine's addresses and its host name. A page
  /// whose name was bound to this address anew (DNS rebinding) has another.
  std::vector<std::string> names;
  std::size_t largest_upload = 256u << 20;  ///< bytes

  // Of a bake, reading the mesh among it.
  double longest_bake_s = 600.0;
  std::uint64_t bake_memory = std::uint64_t{4} << 30;  ///< bytes of address space
  std::size_t most_faces = 2'000'000;
  int threads = 1;
  /// Program and first arguments of the process that bakes (src/serve/bake_process.h).
  std::vector<std::string> bake_command;

  /// Is told, a sentence each, what the one who runs the server should know. Printable.
  std::function<void(const std::string& sentence)> note = [](const std::string&) {};
};

/// Serves the studio, and bakes what its pages send:
///
///     POST /api/bake?name=bunny.obj   a mesh file -> the content of its .mimicry file
///     GET /api/status                 JSON: largest upload, the bake that runs, how many wait
///
/// One event loop carries all connections, so that idle, slow and half-sent ones cost a few
/// kilobytes each. One bake runs at a time, in a process of its own. Refusals are JSON
/// {"error": sentence}. All limits stand in src/serve/limits.h and docs/serve.md.
class Server {
 public:
  /// Binds. Throws Error naming folder, file or port and the remedy.
  explicit Server(const ServeOptions& options);
  ~Server();
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  /// Where it can be reached: the local address first, with `lan` those of the interfaces.
  const std::vector<std::string>& addresses() const;
  /// Answers until `stop`. Throws Error(io) where that fails.
  void run();
  /// From any thread; a bake under way is given up. `run` returns within a second.
  void stop();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace mimicry::serve
