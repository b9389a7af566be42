#include "serve/server.h"

#include <algorithm>
#include <chrono>
#include <optional>
#include <set>
#include <utility>

#include <boost/asio/io_context.hpp>
#include <boost/asio/post.hpp>
#include <nlohmann/json.hpp>
#include <openssl/ssl.h>

#include <mimicry/base/error.h>

#include "files/file.h"
#include "serve/bake_queue.h"
#include "serve/certificate.h"
#include "serve/connection.h"
#include "serve/connections.h"
#include "serve/kept_certificate.h"
#include "serve/limits.h"
#include "serve/network.h"
#include "serve/site.h"
#include "serve/text.h"

namespace mimicry::serve {
namespace {

// What the server answers to: itself, by the addresses of its interfaces (which come and go while
// it runs) and by its names.
KnownHost known_host(const ServeOptions& options) {
  std::set<std::string> names = {"localhost", "127.0.0.1"};
  for (const std::string& name : machine_names()) names.insert(name);
  for (const std::string& name : options.names) {
    const auto host = host_of(name);
    if (!host)
      throw Error(ErrorKind::invalid_input,
                  "--name " + name + ": it is no host name; give one such as studio.example");
    names.insert(*host);
  }
  return [names, lan = options.lan](const std::string& host) {
    if (names.count(host) != 0) return true;
    if (!lan || host.find_first_not_of("0123456789.") != std::string::npos) return false;
    const std::vector<std::string> own = machine_addresses();
    return std::find(own.begin(), own.end(), host) != own.end();
  };
}

Certificate used_certificate(const ServeOptions& options) {
  if (!options.certificate.empty())
    return read_certificate(read_file(options.certificate), options.certificate);
  std::vector<std::string> addresses = machine_addresses();
  addresses.insert(addresses.begin(), "127.0.0.1");
  return kept_certificate(options.data_folder, addresses);
}

std::unique_ptr<asio::ssl::context> tls_context(const ServeOptions& options) {
  if (!options.lan && options.certificate.empty()) return nullptr;
  const Certificate certificate = used_certificate(options);
  auto context = std::make_unique<asio::ssl::context>(asio::ssl::context::tls_server);
  SSL_CTX* const native = context->native_handle();
  SSL_CTX_set_min_proto_version(native, TLS1_2_VERSION);
  SSL_CTX_set_options(native, SSL_OP_NO_RENEGOTIATION);
  if (SSL_CTX_use_certificate(native, certificate.certificate.get()) != 1 ||
      SSL_CTX_use_PrivateKey(native, certificate.key.get()) != 1)
    throw Error(ErrorKind::invalid_input, "the certificate cannot be used; make it anew");
  return context;
}

std::optional<Response> only_files(const Request& request) {
  const std::string type = lower(request.head.field("Content-Type"));
  if (!type.starts_with("multipart/") && !type.starts_with("application/x-www-form-urlencoded"))
    return std::nullopt;
  return refusal(400, "forms are not taken; send the file's bytes as the request's content");
}

}  // namespace

struct Server::State {
  ServeOptions options;
  Site site;
  Connections connections;
  asio::io_context io{1};  // what waits in it uses what stands above
  BakeQueue bakes;
  std::unique_ptr<asio::ssl::context> tls;
  tcp::acceptor acceptor{io};
  asio::steady_timer pause{io}, farewell{io};
  std::vector<std::string> addresses;

  explicit State(const ServeOptions& given)
      : options(given),
        connections(
            std::min(limits::kConnections,
                     std::max<std::size_t>(allow_files(limits::kConnections + limits::kOtherFiles),
                                           2 * limits::kOtherFiles) -
                         limits::kOtherFiles)),
        bakes(io, options, connections.held) {
    site.pages = std::make_shared<const Pages>(options.studio);
    site.known_host = known_host(options);
    site.routes = routes();
    tls = tls_context(options);
    bind();
  }

  std::vector<Route> routes() {
    Route status{"GET", "/api/status", 0, {}, [this](const std::shared_ptr<Exchange>& exchange) {
                   exchange->answer(status_now());
                 }};
    Route bake{"POST", "/api/bake", options.largest_upload,
               [this](const Request& request) {
                 auto no = only_files(request);
                 return no ? std::move(no) : bakes.refusal_for(request.client);
               },
               [this](std::shared_ptr<Exchange> exchange) { bakes.add(std::move(exchange)); }};
    return {std::move(status), std::move(bake)};
  }

  Response status_now() const {
    nlohmann::json status = {{"program", "mimicry"},
                             {"bakes", true},
                             {"largest_upload", options.largest_upload},
                             {"waiting", bakes.waiting()}};
    if (const std::string stage = bakes.stage(); !stage.empty())
      status["bake"] = {{"stage", stage}, {"fraction", bakes.fraction()}};
    Response response = Response::text(200, "application/json", status.dump());
    response.fields.emplace_back("Cache-Control", "no-store");
    return response;
  }

  void bind() {
    const tcp::endpoint where(
        options.lan ? asio::ip::address_v4::any() : asio::ip::address_v4::loopback(),
        static_cast<unsigned short>(options.port));
    Trouble trouble;
    acceptor.open(where.protocol(), trouble);
    // One server a port: a second program on it is an error, not a share of the requests.
    if (!trouble) acceptor.set_option(tcp::acceptor::reuse_address(true), trouble);
    if (!trouble) acceptor.bind(where, trouble);
    if (!trouble) acceptor.listen(asio::socket_base::max_listen_connections, trouble);
    if (trouble)
      throw Error(ErrorKind::io, "port " + std::to_string(options.port) + " cannot be had (" +
                                     trouble.message() +
                                     "); choose another with --port (0: any that is free)");
    const std::string scheme = tls ? "https://" : "http://";
    const std::string end = ":" + std::to_string(acceptor.local_endpoint().port()) + "/";
    addresses.push_back(scheme + "127.0.0.1" + end);
    if (options.lan)
      for (const std::string& address : machine_addresses())
        addresses.push_back(scheme + address + end);
  }

  void accept() {
    acceptor.async_accept([this](Trouble trouble, tcp::socket socket) {
      if (!acceptor.is_open()) return;
      if (!trouble) {
        accept();  // first: whatever comes of this one, the next is taken
        return welcome(std::move(socket));
      }
      // The system has no file left, or the client went away again.
      connections.end_longest_waiting();
      pause.expires_after(std::chrono::milliseconds(20));
      pause.async_wait([this](Trouble) {
        if (acceptor.is_open()) accept();
      });
    });
  }

  void welcome(tcp::socket socket) {
    Trouble none;
    socket.set_option(tcp::no_delay(true), none);
    const auto connection = Connection::make(std::move(socket), tls.get(), site, connections);
    if (connections.add(connection)) connection->start();
  }

  void end() {
    if (!acceptor.is_open()) return;
    Trouble none;
    acceptor.close(none);
    for (const auto& connection : connections.all()) connection->end_unless_answering();
    bakes.stop();
    last_answers(std::chrono::steady_clock::now() + limits::kFarewell);
  }

  void last_answers(std::chrono::steady_clock::time_point end) {
    if (connections.all().empty() || std::chrono::steady_clock::now() >= end) return io.stop();
    farewell.expires_after(std::chrono::milliseconds(10));
    farewell.async_wait([this, end](Trouble) { last_answers(end); });
  }
};

Server::Server(const ServeOptions& options) try : state_(std::make_unique<State>(options)) {
} catch (const boost::system::system_error& error) {
  throw Error(ErrorKind::io, std::string("the server cannot start: ") + error.what() +
                                 "; raise the limits of this user or container (ulimit -a)");
}

Server::~Server() = default;

const std::vector<std::string>& Server::addresses() const {
  return state_->addresses;
}

void Server::run() {
  state_->accept();
  for (;;) {
    try {
      state_->io.run();
      return;
    } catch (const std::exception& error) {
      // Of one request: the others go on.
      state_->options.note("a request failed: " + printable(error.what()));
    }
  }
}

void Server::stop() {
  asio::post(state_->io, [this] { state_->end(); });
}

}  // namespace mimicry::serve
