#include "serve/connection.h"

#include <ctime>
#include <limits>
#include <utility>

#include <mimicry/base/error.h>

#include "serve/limits.h"
#include "serve/text.h"

namespace mimicry::serve {
namespace {

// The page runs its own WebAssembly and workers, keeps what it draws in blobs, and talks to nobody
// else. No page of another site may show it in a frame or take its files into itself.
constexpr std::pair<const char*, const char*> kEveryAnswer[] = {
    {"Content-Security-Policy",
     "default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; worker-src 'self'; "
     "style-src 'self'; img-src 'self' data: blob:; font-src 'self'; connect-src 'self'; "
     "manifest-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'"},
    {"X-Content-Type-Options", "nosniff"},
    {"X-Frame-Options", "DENY"},
    {"Referrer-Policy", "no-referrer"},
    {"Cross-Origin-Opener-Policy", "same-origin"},
    {"Cross-Origin-Resource-Policy", "same-origin"}};

bool is_of_http(Trouble trouble) {
  return trouble.category() == http::make_error_code(http::error::bad_method).category();
}

std::string http_date() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  char text[64] = "";
  std::strftime(text, sizeof text, "%a, %d %b %Y %H:%M:%S GMT", gmtime_r(&now, &parts));
  return text;
}

std::chrono::nanoseconds time_for(std::uint64_t bytes) {
  return limits::kGrace +
         std::chrono::nanoseconds(1'000'000'000 / limits::kLeastBytesPerSecond * bytes);
}

std::string to_string(beast::string_view text) {
  return {text.data(), text.size()};
}

Response too_large(const Route& route) {
  return refusal(413, "the model is larger than " + megabytes(route.largest_body) +
                          "; simplify it, or bake it with the command line");
}

}  // namespace

Head head_of(const http::header<true, http::fields>& header) {
  Head head;
  head.method = to_string(header.method_string());
  head.target = to_string(header.target());
  head.is_http_1_1 = header.version() == 11;
  for (const auto& field : header)
    head.fields.emplace_back(to_string(field.name_string()), to_string(field.value()));
  return head;
}

class Connection::Pending final : public Exchange {
 public:
  explicit Pending(Connection& connection) : connection_(connection.weak_from_this()) {}
  void answer(Response response) override {
    const auto connection = connection_.lock();
    if (connection && connection->pending_.get() == this) connection->answered(std::move(response));
  }

 private:
  std::weak_ptr<Connection> connection_;
};

Connection::~Connection() {
  leave_waiting();
  all_.remove_upload(*this);
  all_.remove(*this);
}

void Connection::start() {
  expect_by(Clock::now() + limits::kHandshakeTime);
  waiting_ = all_.wait(*this);
  shake_hands();
}

void Connection::end() {
  if (stage_ == Stage::ended) return;
  const auto self = shared_from_this();
  stage_ = Stage::ended;
  leave_waiting();
  all_.remove_upload(*this);
  all_.remove(*this);
  timer_.cancel();
  Trouble none;
  socket().close(none);
  if (const auto left = std::exchange(pending_, nullptr); left && left->on_leave) left->on_leave();
}

void Connection::end_unless_answering() {
  if (stage_ != Stage::answering && stage_ != Stage::writing && stage_ != Stage::closing) end();
}

double Connection::upload_rate() const {
  const std::chrono::duration<double> since = Clock::now() - begun_;
  if (since < std::chrono::seconds(1)) return limits::kFastBytesPerSecond;
  return static_cast<double>(moved_) / since.count();
}

void Connection::expect_by(Clock::time_point deadline) {
  deadline_ = deadline;
  timer_.expires_at(deadline);
  timer_.async_wait([self = shared_from_this()](Trouble trouble) {
    if (!trouble && Clock::now() >= self->deadline_) self->on_deadline();
  });
}

void Connection::on_deadline() {
  if (stage_ == Stage::answering) return;  // a bake has a limit of its own
  if (stage_ != Stage::body) return end();
  timed_out_ = true;
  Trouble none;
  socket().cancel(none);
}

void Connection::on_handshake(Trouble trouble) {
  if (trouble || stage_ == Stage::ended) return end();
  leave_waiting();
  await_request();
}

void Connection::leave_waiting() {
  if (waiting_) all_.stop_waiting(*waiting_);
  waiting_.reset();
}

void Connection::await_request() {
  stage_ = Stage::head;
  serializer_.reset();
  answer_.reset();
  keeper_.reset();
  pending_.reset();
  parser_.emplace();
  parser_->header_limit(limits::kHeadBytes);
  parser_->body_limit(std::numeric_limits<std::uint64_t>::max());  // each route has its own
  keep_alive_ = true;
  is_head_ = continued_ = false;
  waiting_ = all_.wait(*this);
  expect_by(Clock::now() + limits::kHeadTime);
  read_head();
}

void Connection::on_head(Trouble trouble) {
  leave_waiting();
  if (stage_ == Stage::ended) return;
  if (trouble == http::error::header_limit || trouble == http::error::buffer_overflow)
    return refuse(refusal(
        431, "the request's head is larger than " + std::to_string(limits::kHeadBytes) + " bytes"));
  if (trouble && is_of_http(trouble) && trouble != http::error::end_of_stream &&
      trouble != http::error::partial_message)
    return refuse(refusal(400, "the request is not well formed: " + trouble.message()));
  if (trouble) return end();
  Head head = head_of(parser_->get());
  is_head_ = head.method == "HEAD";
  keep_alive_ = parser_->keep_alive();
  take(std::move(head));
}

void Connection::take(Head head) {
  auto checked = check_head(std::move(head), site_.known_host);
  if (auto* no = std::get_if<Response>(&checked)) return refuse(std::move(*no));
  pending_ = std::make_shared<Pending>(*this);
  pending_->request = std::move(std::get<Request>(checked));
  Request& request = pending_->request;
  request.client = client_;
  auto found = site_.find(request);
  const bool has_body = !parser_->is_done();
  if (auto* answer = std::get_if<Response>(&found))
    return has_body ? refuse(std::move(*answer)) : send(std::move(*answer));
  route_ = std::get<const Route*>(found);
  if (route_->admit)
    if (const auto no = route_->admit(request)) return refuse(std::move(*no));
  if (!has_body) return handle();
  take_body(*route_);
}

void Connection::take_body(const Route& route) {
  const std::uint64_t announced = parser_->content_length().value_or(0);
  if (route.largest_body == 0) return refuse(refusal(413, "no content is taken here"));
  if (announced > route.largest_body) return refuse(too_large(route));
  if (*all_.held + announced > limits::kHeldBytes)
    return refuse(busy("other models fill the server's memory; try again in a while"));
  const std::string_view expected = pending_->request.head.field("Expect");
  if (!expected.empty() && expected != "100-continue")
    return refuse(refusal(417, "of what can be expected only 100-continue is known"));
  begun_ = Clock::now();
  moved_ = 0;
  if (!all_.add_upload(*this))
    return refuse(busy("many models are being sent; try again in a while"));
  try {
    pending_->request.body = MemoryFile::make(all_.held);
  } catch (const Error& error) {
    return refuse(busy(error.what()));
  }
  chunk_.resize(32 * 1024);
  stage_ = Stage::body;
  if (!expected.empty()) return send_continue();
  read_more_body();
}

void Connection::read_more_body() {
  expect_by(begun_ + time_for(moved_));
  auto& body = parser_->get().body();
  body.data = chunk_.data();
  body.size = chunk_.size();
  body.more = true;
  read_body();
}

void Connection::on_body(Trouble trouble) {
  if (stage_ == Stage::ended) return;
  if (timed_out_) {
    timed_out_ = false;
    return refuse(refusal(408, "the model came too slowly; send it again"));
  }
  if (trouble == http::error::need_buffer) trouble = {};
  if (trouble && is_of_http(trouble))
    return refuse(refusal(400, trouble == http::error::partial_message
                                   ? "the model did not arrive whole; send it again"
                                   : "the request is not well formed: " + trouble.message()));
  if (trouble) return end();
  const std::size_t count = chunk_.size() - parser_->get().body().size;
  moved_ += count;
  if (moved_ > route_->largest_body) return refuse(too_large(*route_));
  if (*all_.held + count > limits::kHeldBytes ||
      !pending_->request.body.append({chunk_.data(), count}))
    return refuse(busy("other models fill the server's memory; try again in a while"));
  if (!parser_->is_done()) return read_more_body();
  handle();
}

void Connection::handle() {
  all_.remove_upload(*this);
  chunk_ = {};
  stage_ = Stage::answering;
  const auto exchange = pending_;
  try {
    route_->handle(exchange);
  } catch (const std::exception& error) {
    if (pending_ == exchange) exchange->answer(refusal(500, error.what()));
  }
  if (stage_ != Stage::answering) return;
  // The answer comes later. Whether the client is still there is seen by reading, and what it sends
  // meanwhile is not kept: this is the connection's last request.
  keep_alive_ = false;
  watching_ = true;
  watch();
}

void Connection::answered(Response response) {
  if (stage_ != Stage::answering) return;
  send(std::move(response));
}

void Connection::refuse(Response response) {
  all_.remove_upload(*this);
  chunk_ = {};
  keep_alive_ = false;  // what is left of the request is not read
  send(std::move(response));
}

void Connection::send_continue() {
  continued_ = true;
  answer_.emplace();
  answer_->result(http::status::continue_);
  serializer_.emplace(*answer_);
  write();
}

void Connection::send(Response response) {
  pending_.reset();
  stage_ = Stage::writing;
  continued_ = false;
  serializer_.reset();
  answer_.emplace();
  answer_->version(11);
  answer_->result(static_cast<unsigned>(response.status));
  answer_->set(http::field::date, http_date());
  for (const auto& [name, value] : kEveryAnswer) answer_->set(name, value);
  for (const auto& [name, value] : response.fields) answer_->insert(name, value);
  answer_->set(http::field::connection, keep_alive_ ? "keep-alive" : "close");
  if (response.status != 304) answer_->content_length(response.body.size());
  keeper_ = response.keeper;
  if (!is_head_ && response.status != 304)
    answer_->body() = beast::span<const char>(response.body.data(), response.body.size());
  serializer_.emplace(*answer_);
  begun_ = Clock::now();
  moved_ = 0;
  expect_by(begun_ + time_for(0));
  write();
}

void Connection::on_written(Trouble trouble, std::size_t bytes) {
  if (trouble || stage_ == Stage::ended) return end();
  if (!continued_) moved_ += bytes;
  if (!serializer_->is_done()) {
    expect_by(begun_ + time_for(moved_));
    return write();
  }
  if (continued_) {
    continued_ = false;
    return read_more_body();
  }
  if (keep_alive_) return await_request();
  drain();
}

// A connection that is closed with something unread is reset, and the client may lose the answer.
void Connection::drain() {
  stage_ = Stage::closing;
  keeper_.reset();
  expect_by(Clock::now() + limits::kDrainTime);
  stop_sending();
  if (std::exchange(watching_, true)) return;
  watch();
}

void Connection::on_watched(Trouble trouble) {
  if (trouble) watching_ = false;
  if (stage_ == Stage::ended) return;
  if (!trouble) return watch();
  if (stage_ == Stage::answering || stage_ == Stage::closing) end();
}

}  // namespace mimicry::serve
