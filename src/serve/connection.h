#pragma once

#include <array>
#include <chrono>
#include <memory>
#include <optional>
#include <string>

#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/ssl/context.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/http/buffer_body.hpp>
#include <boost/beast/http/fields.hpp>
#include <boost/beast/http/parser.hpp>
#include <boost/beast/http/serializer.hpp>
#include <boost/beast/http/span_body.hpp>

#include "serve/connections.h"
#include "serve/site.h"

namespace mimicry::serve {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = boost::beast::http;
using asio::ip::tcp;
using Trouble = boost::system::error_code;

/// A parsed head in words of our own.
Head head_of(const http::header<true, http::fields>& header);

/// One client's connection: requests one after the other, each with its limits. It lives while an
/// operation of it is under way. All of it runs on the event loop's one thread.
class Connection : public std::enable_shared_from_this<Connection> {
 public:
  /// tls: null for plain HTTP.
  static std::shared_ptr<Connection> make(tcp::socket socket, asio::ssl::context* tls,
                                          const Site& site, Connections& all);
  virtual ~Connection();

  void start();
  /// At once, whatever it does; a request that is being answered learns of it.
  void end();
  /// Unless an answer is under way.
  void end_unless_answering();

  const std::string& client() const { return client_; }
  /// Bytes a second; that of one that has just begun is high.
  double upload_rate() const;

 protected:
  using Clock = std::chrono::steady_clock;
  using Parser = http::request_parser<http::buffer_body>;
  using Answer = http::response<http::span_body<const char>>;
  using Serializer = http::response_serializer<http::span_body<const char>>;

  Connection(std::string client, const asio::any_io_executor& executor, const Site& site,
             Connections& all)
      : client_(std::move(client)), site_(site), all_(all), timer_(executor) {}

  // What depends on what is beneath: each starts an operation that ends in the function named.
  virtual tcp::socket& socket() = 0;
  virtual void shake_hands() = 0;  // on_handshake
  virtual void read_head() = 0;    // on_head
  virtual void read_body() = 0;    // on_body
  virtual void write() = 0;        // on_written
  virtual void watch() = 0;        // on_watched
  /// Tells the client that nothing more comes, where that leaves reading alone.
  virtual void stop_sending() = 0;

  void on_handshake(Trouble trouble);
  void on_head(Trouble trouble);
  void on_body(Trouble trouble);
  void on_written(Trouble trouble, std::size_t bytes);
  void on_watched(Trouble trouble);

  beast::flat_buffer buffer_{64 * 1024};
  std::optional<Parser> parser_;
  std::optional<Answer> answer_;
  std::optional<Serializer> serializer_;
  std::array<char, 4096> unread_{};  // what comes while nobody reads

 private:
  enum class Stage { handshake, head, body, answering, writing, closing, ended };
  class Pending;

  void await_request();
  void leave_waiting();
  void take(Head head);
  void take_body(const Route& route);
  void read_more_body();
  void handle();
  void refuse(Response response);
  void send(Response response);
  void send_continue();
  void answered(Response response);
  void drain();
  void expect_by(Clock::time_point deadline);
  void on_deadline();

  const std::string client_;
  const Site& site_;
  Connections& all_;
  asio::steady_timer timer_;
  Clock::time_point deadline_ = Clock::time_point::max();
  Stage stage_ = Stage::handshake;
  std::optional<Connections::Waiting::iterator> waiting_;

  const Route* route_ = nullptr;
  std::shared_ptr<Pending> pending_;
  bool is_head_ = false, keep_alive_ = true;
  bool watching_ = false, timed_out_ = false, continued_ = false;
  Clock::time_point begun_;  // of a body or an answer
  std::uint64_t moved_ = 0;  // bytes of it
  std::string chunk_;
  std::shared_ptr<const void> keeper_;
};

}  // namespace mimicry::serve
