#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <new>
#include <thread>
#include <utility>

#include <arpa/inet.h>
#include <ifaddrs.h>
#include <net/if.h>
#include <nlohmann/json.hpp>
#include <zlib.h>

#include <mimicry/bake/bake.h>
#include <mimicry/base/error.h>
#include <mimicry/files/file.h>
#include <mimicry/io/embedding_file.h>
#include <mimicry/io/mesh_reader.h>
#include <mimicry/serve/server.h>

#include "serve/bake_queue.h"
#include "serve/certificate.h"

// Last: <resolv.h> makes a macro of a name that Eigen uses.
#include <httplib.h>

namespace mimicry::serve {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;
using httplib::Request;
using httplib::Response;

constexpr std::array<std::pair<std::string_view, const char*>, 13> kTypes = {{
    {".html", "text/html; charset=utf-8"},
    {".js", "text/javascript; charset=utf-8"},
    {".css", "text/css; charset=utf-8"},
    {".json", "application/json"},
    {".webmanifest", "application/manifest+json"},
    {".wasm", "application/wasm"},
    {".svg", "image/svg+xml"},
    {".png", "image/png"},
    {".ico", "image/x-icon"},
    {".woff2", "font/woff2"},
    {".glb", "model/gltf-binary"},
    {".txt", "text/plain; charset=utf-8"},
    {".map", "application/json"},
}};

constexpr std::size_t kMostPacked = std::size_t{1} << 30;

const char* type_of(const fs::path& file) {
  const std::string ending = file.extension().string();
  for (const auto& [known, type] : kTypes)
    if (ending == known) return type;
  return "application/octet-stream";
}

// For WebAssembly: the HTTP library compresses text alone.
std::string gzipped(std::string_view content) {
  constexpr int kGzip = 15 + 16;  // the window's bits, and gzip's header
  z_stream stream{};
  if (deflateInit2(&stream, Z_DEFAULT_COMPRESSION, Z_DEFLATED, kGzip, 8, Z_DEFAULT_STRATEGY) !=
      Z_OK)
    throw std::bad_alloc();
  std::string packed(deflateBound(&stream, static_cast<uLong>(content.size())), '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(content.data()));
  stream.avail_in = static_cast<uInt>(content.size());
  stream.next_out = reinterpret_cast<Bytef*>(packed.data());
  stream.avail_out = static_cast<uInt>(packed.size());
  deflate(&stream, Z_FINISH);  // there is room for all of it
  packed.resize(stream.total_out);
  deflateEnd(&stream);
  return packed;
}

// The IPv4 addresses of the machine's interfaces; those of a network of its own first.
std::vector<std::string> machine_addresses() {
  std::vector<std::string> found;
  ifaddrs* list = nullptr;
  if (getifaddrs(&list) != 0) return found;
  for (const ifaddrs* i = list; i; i = i->ifa_next) {
    if (!i->ifa_addr || i->ifa_addr->sa_family != AF_INET) continue;
    if (!(i->ifa_flags & IFF_UP) || (i->ifa_flags & IFF_LOOPBACK)) continue;
    char text[INET_ADDRSTRLEN] = "";
    sockaddr_in address{};
    std::memcpy(&address, i->ifa_addr, sizeof address);
    if (inet_ntop(AF_INET, &address.sin_addr, text, sizeof text)) found.emplace_back(text);
  }
  freeifaddrs(list);
  return found;
}

fs::path made_folder(const std::string& folder) {
  std::error_code trouble;
  fs::create_directories(folder, trouble);
  if (trouble)
    throw Error(ErrorKind::io, folder + ": the folder cannot be made: " + trouble.message() +
                                   "; name another with --data");
  return folder;
}

Certificate lan_certificate(const ServeOptions& options,
                            const std::vector<std::string>& addresses) {
  if (!options.certificate.empty())
    return read_certificate(files::read_file(options.certificate), options.certificate);
  const fs::path kept = made_folder(options.data_folder) / "certificate.pem";
  // A headset that has accepted it is not asked again.
  if (fs::exists(kept)) {
    try {
      Certificate known = read_certificate(files::read_file(kept.string()), kept.string());
      if (serves(known, addresses)) return known;
    } catch (const Error&) {  // it is made again
    }
  }
  Certificate made = make_certificate(addresses);
  files::write_file_atomically(kept.string(), "");
  fs::permissions(kept, fs::perms::owner_read | fs::perms::owner_write);
  files::write_file_atomically(kept.string(), write_certificate(made));
  fs::permissions(kept, fs::perms::owner_read | fs::perms::owner_write);
  return made;
}

void refuse(Response& response, int status, const std::string& sentence) {
  response.status = status;
  response.set_content(nlohmann::json{{"error", sentence}}.dump(), "application/json");
  // What is left of the request's body is not read.
  response.set_header("Connection", "close");
}

// A page of another site names its own host as origin.
bool is_foreign(const Request& request) {
  const std::string origin = request.get_header_value("Origin");
  if (origin.empty()) return false;
  const std::string host = request.get_header_value("Host");
  return origin != "http://" + host && origin != "https://" + host;
}

}  // namespace

struct Server::State {
  ServeOptions options;
  fs::path studio;  // canonical
  Certificate certificate;
  std::unique_ptr<httplib::Server> http;
  std::vector<std::string> addresses;
  BakeQueue queue;
  std::atomic<bool> stopping{false};
  std::atomic<bool> idle{true};

  void send_file(const Request& request, Response& response) const {
    std::error_code trouble;
    const std::string wanted = request.path == "/" ? "/index.html" : request.path;
    // Links are followed before it is asked whether the file lies inside.
    const fs::path file = fs::canonical(studio / wanted.substr(1), trouble);
    const bool inside =
        !trouble &&
        std::mismatch(studio.begin(), studio.end(), file.begin(), file.end()).first == studio.end();
    if (!inside || wanted.find('\0') != std::string::npos || !fs::is_regular_file(file, trouble))
      return refuse(response, 404, request.path + ": there is no such file");
    std::string content = files::read_file(file.string());
    if (file.extension() == ".wasm") {
      response.set_header("Vary", "Accept-Encoding");
      if (!request.has_header("Range") && content.size() < kMostPacked &&
          request.get_header_value("Accept-Encoding").find("gzip") != std::string::npos) {
        content = gzipped(content);
        response.set_header("Content-Encoding", "gzip");
      }
    }
    response.set_content(std::move(content), type_of(file));
    // Built files carry a hash of their content in their names.
    const bool immutable = request.path.starts_with("/assets/");
    response.set_header("Cache-Control",
                        immutable ? "public, max-age=31536000, immutable" : "no-cache");
  }

  void bake(const Request& request, Response& response, const httplib::ContentReader& read) {
    if (is_foreign(request)) return refuse(response, 403, "only the studio's own pages may bake");
    BakeQueue::Place place(queue);
    if (!place) {
      response.set_header("Retry-After", "10");
      return refuse(response, 503,
                    "one model is being baked and another waits; try again in a while");
    }
    const auto too_large = [&] {
      refuse(response, 413,
             "the model is larger than " + std::to_string(options.largest_upload >> 20) +
                 " MB; simplify it, or bake it with the command line");
    };
    const auto announced = request.get_header_value<std::uint64_t>("Content-Length");
    if (announced > options.largest_upload) return too_large();
    std::string mesh;
    bool fits = true;
    const bool whole = read([&](const char* data, std::size_t size) {
      fits = mesh.size() + size <= options.largest_upload;
      if (fits) mesh.append(data, size);
      return fits;
    });
    if (!fits) return too_large();
    if (!whole) return refuse(response, 400, "the model did not arrive whole; send it again");
    place.wait();
    const std::string name = request.get_param_value("name");
    response.set_content(baked(mesh, name.empty() ? "model" : name), "application/octet-stream");
  }

  std::string baked(const std::string& bytes, const std::string& name) const {
    const TriangleMesh mesh = io::read_mesh(bytes, io::mesh_format_of(name), name);
    char digits[17];
    std::snprintf(digits, sizeof digits, "%016llx",
                  static_cast<unsigned long long>(embedding::content_hash(mesh)));
    const fs::path kept = made_folder(options.data_folder) / (std::string(digits) + ".mimicry");
    if (fs::exists(kept)) {
      std::string known = files::read_file(kept.string());
      try {
        const embedding::Embedding e = io::read_embedding(known, kept.string());
        if (e.mesh_vertex_count == mesh.vertex_count() && e.face_count() == mesh.face_count())
          return known;
      } catch (const Error&) {  // it is made again
      }
    }
    const auto end = Clock::now() + std::chrono::duration<double>(options.longest_bake_s);
    const embedding::Embedding made =
        mimicry::bake::bake(mesh, {}, options.threads,
                            [&](const Progress&) { return !stopping && Clock::now() < end; });
    std::string file = io::write_embedding(made);
    files::write_file_atomically(kept.string(), file);
    return file;
  }

  void status(Response& response) const {
    response.set_content(
        nlohmann::json{
            {"program", "mimicry"}, {"bakes", true}, {"largest_upload", options.largest_upload}}
            .dump(),
        "application/json");
  }

  void answer() {
    http->set_default_headers({{"X-Content-Type-Options", "nosniff"}});
    http->set_payload_max_length(options.largest_upload);
    // One server a port: a second program on it is an error, not a share of the requests.
    http->set_socket_options([](socket_t socket) {
      int yes = 1;
      setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
    });
    http->Get("/api/status", [this](const Request&, Response& response) { status(response); });
    http->Post("/api/bake",
               [this](const Request& request, Response& response,
                      const httplib::ContentReader& read) { bake(request, response, read); });
    http->Get(".*",
              [this](const Request& request, Response& response) { send_file(request, response); });
    http->set_exception_handler(
        [this](const Request&, Response& response, std::exception_ptr thrown) {
          try {
            std::rethrow_exception(thrown);
          } catch (const Error& error) {
            if (error.kind() == ErrorKind::cancelled)
              return refuse(response, 503,
                            stopping ? "the server was stopped"
                                     : "the bake took longer than is allowed; simplify "
                                       "the model, or bake it with the command line");
            refuse(response, error.kind() == ErrorKind::io ? 500 : 422, error.what());
          } catch (const std::bad_alloc&) {
            refuse(response, 507, "the model is too large for this machine's memory");
          } catch (const std::exception& error) {
            refuse(response, 500, error.what());
          }
        });
  }

  void bind() {
    const char* host = options.lan ? "0.0.0.0" : "127.0.0.1";
    int port = options.port;
    if (port == 0)
      port = http->bind_to_any_port(host);
    else if (!http->bind_to_port(host, port))
      port = -1;
    if (port <= 0)
      throw Error(ErrorKind::io, "port " + std::to_string(options.port) +
                                     " cannot be had, another program uses it; choose another with "
                                     "--port (0: any that is free)");
    const std::string scheme = certificate.certificate ? "https://" : "http://";
    const std::string end = ":" + std::to_string(port) + "/";
    addresses.push_back(scheme + "127.0.0.1" + end);
    if (options.lan)
      for (const std::string& address : machine_addresses())
        addresses.push_back(scheme + address + end);
  }
};

Server::Server(const ServeOptions& options) : state_(std::make_unique<State>()) {
  State& s = *state_;
  s.options = options;
  std::error_code trouble;
  s.studio = fs::canonical(options.studio, trouble);
  if (trouble || !fs::is_regular_file(s.studio / "index.html", trouble))
    throw Error(ErrorKind::io, options.studio +
                                   ": the studio is not there; build it with `cmake --preset wasm "
                                   "&& cmake --build --preset wasm --target web_page` (or ./run), "
                                   "or name its folder with --studio");
  if (options.lan || !options.certificate.empty()) {
    std::vector<std::string> names = machine_addresses();
    names.insert(names.begin(), "127.0.0.1");
    s.certificate = lan_certificate(options, names);
    s.http = std::make_unique<httplib::SSLServer>(s.certificate.certificate.get(),
                                                  s.certificate.key.get());
  } else {
    s.http = std::make_unique<httplib::Server>();
  }
  if (!s.http->is_valid())
    throw Error(ErrorKind::invalid_input, "the certificate cannot be used; make it anew");
  s.answer();
  s.bind();
}

Server::~Server() = default;

const std::vector<std::string>& Server::addresses() const {
  return state_->addresses;
}

void Server::run() {
  state_->idle = false;
  const bool ended = state_->stopping || state_->http->listen_after_bind();
  state_->idle = true;
  if (!ended && !state_->stopping)
    throw Error(ErrorKind::io, "the server could not go on listening; start it again");
}

void Server::stop() {
  state_->stopping = true;
  // The library passes over a stop that comes before it listens.
  while (!state_->idle) {
    state_->http->stop();
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
}

}  // namespace mimicry::serve
