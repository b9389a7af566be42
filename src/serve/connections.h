#pragma once

#include <cstddef>
#include <list>
#include <map>
#include <memory>
#include <string>

#include "serve/memory_file.h"

namespace mimicry::serve {

class Connection;

/// All connections, those that wait for a request's head in the order in which they began to, and
/// the uploads. Who holds more than limits.h allows loses what has waited longest or is slowest, so
/// that no number of idle, half-sent or slow requests keeps another out.
class Connections {
 public:
  using Waiting = std::list<Connection*>;

  explicit Connections(std::size_t most) : most_(most) {}

  /// Ends others where there are too many; false where none can be.
  bool add(const std::shared_ptr<Connection>& connection);
  void remove(Connection& connection);

  Waiting::iterator wait(Connection& connection);
  void stop_waiting(Waiting::iterator place);
  /// Of the client where one is named; false where none waits.
  bool end_longest_waiting(const std::string* client = nullptr);

  /// Ends a slow one where there are too many; false where none is slow.
  bool add_upload(Connection& connection);
  void remove_upload(Connection& connection);

  /// A copy: they may end while one walks over it.
  std::list<std::shared_ptr<Connection>> all() const;
  const HeldBytes held = std::make_shared<std::uint64_t>(0);

 private:
  bool end_slowest_upload(const std::string* client);

  std::size_t most_;
  std::map<Connection*, std::weak_ptr<Connection>> all_;
  std::map<std::string, std::size_t> of_client_;
  Waiting waiting_;
  std::list<Connection*> uploads_;
};

}  // namespace mimicry::serve
