#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace mimicry::serve {

struct ServeOptions {
  std::string studio;       ///< folder with the page; only files inside it are read
  std::string data_folder;  ///< of bakes and the certificate; nothing is written elsewhere
  int port = 8080;          ///< 0: any that is free
  /// Listen on all interfaces, with HTTPS (a headset gives VR to secure pages only), and not on
  /// 127.0.0.1 alone.
  bool lan = false;
  /// PEM file with a certificate and its key; with `lan` and without one a self-signed certificate
  /// with the machine's addresses is made and kept in the data folder.
  std::string certificate;
  std::size_t largest_upload = 256u << 20;  ///< bytes
  double longest_bake_s = 600.0;
  int threads = 1;  ///< of a bake
};

/// Serves the studio, and bakes what its pages send:
///
///     POST /api/bake?name=bunny.obj   a mesh file -> the content of its .mimicry file
///     GET /api/status                 JSON: version, largest upload
///
/// One bake runs and one waits; more are refused with 503. Refusals are JSON {"error": sentence}.
/// Requests from other sites' pages are refused.
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
  /// From any thread; a bake under way is cancelled.
  void stop();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace mimicry::serve
