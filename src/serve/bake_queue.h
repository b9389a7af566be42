#pragma once

#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include <boost/asio/io_context.hpp>

#include "serve/bake_process.h"
#include "serve/message.h"
#include "serve/server.h"

namespace mimicry::serve {

/// One bake runs, others wait for their turn in the order in which their meshes arrived whole. One
/// whose client leaves is given up.
class BakeQueue {
 public:
  BakeQueue(boost::asio::io_context& io, const ServeOptions& options, HeldBytes held)
      : io_(io), options_(options), held_(std::move(held)) {}

  /// Why a bake of this client is not taken now.
  std::optional<Response> refusal_for(const std::string& client) const;
  void add(std::shared_ptr<Exchange> exchange);
  /// Gives up all, answers them and takes no more.
  void stop();

  /// JSON members for the server's status: of the bake that runs, and how many wait.
  std::string stage() const;
  double fraction() const;
  std::size_t waiting() const { return waiting_.size(); }

 private:
  void start_next();
  void leave(const Exchange* exchange);

  boost::asio::io_context& io_;
  const ServeOptions& options_;
  HeldBytes held_;
  std::deque<std::shared_ptr<Exchange>> waiting_;
  std::shared_ptr<Exchange> current_;
  std::shared_ptr<BakeProcess> process_;
  bool stopped_ = false;
};

}  // namespace mimicry::serve
