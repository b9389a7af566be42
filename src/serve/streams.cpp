// The HTTP library is compiled once for plain connections and once for TLS, here alone.
#include <boost/asio/ssl/stream.hpp>
#include <boost/beast/http/read.hpp>
#include <boost/beast/http/write.hpp>

#include "serve/connection.h"

namespace mimicry::serve {
namespace {

template <class Stream>
class Over final : public Connection {
 public:
  Over(Stream stream, std::string client, const Site& site, Connections& all)
      : Connection(std::move(client), stream.get_executor(), site, all),
        stream_(std::move(stream)) {}

 private:
  static constexpr bool kIsSecure = !std::is_same_v<Stream, tcp::socket>;

  std::shared_ptr<Over> self() { return std::static_pointer_cast<Over>(shared_from_this()); }

  tcp::socket& socket() override {
    if constexpr (kIsSecure)
      return stream_.next_layer();
    else
      return stream_;
  }
  void shake_hands() override {
    if constexpr (kIsSecure)
      stream_.async_handshake(asio::ssl::stream_base::server,
                              [self = self()](Trouble trouble) { self->on_handshake(trouble); });
    else
      on_handshake({});
  }
  void read_head() override {
    http::async_read_header(
        stream_, buffer_, *parser_,
        [self = self()](Trouble trouble, std::size_t) { self->on_head(trouble); });
  }
  void read_body() override {
    http::async_read_some(
        stream_, buffer_, *parser_,
        [self = self()](Trouble trouble, std::size_t) { self->on_body(trouble); });
  }
  void write() override {
    http::async_write_some(
        stream_, *serializer_,
        [self = self()](Trouble trouble, std::size_t bytes) { self->on_written(trouble, bytes); });
  }
  void watch() override {
    stream_.async_read_some(asio::buffer(unread_), [self = self()](Trouble trouble, std::size_t) {
      self->on_watched(trouble);
    });
  }
  void stop_sending() override {
    Trouble none;
    if constexpr (!kIsSecure) stream_.shutdown(tcp::socket::shutdown_send, none);
  }

  Stream stream_;
};

}  // namespace

std::shared_ptr<Connection> Connection::make(tcp::socket socket, asio::ssl::context* tls,
                                             const Site& site, Connections& all) {
  Trouble trouble;
  const auto client = socket.remote_endpoint(trouble).address().to_string();
  if (tls)
    return std::make_shared<Over<asio::ssl::stream<tcp::socket>>>(
        asio::ssl::stream<tcp::socket>(std::move(socket), *tls), client, site, all);
  return std::make_shared<Over<tcp::socket>>(std::move(socket), client, site, all);
}

}  // namespace mimicry::serve
