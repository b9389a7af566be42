#include "serve/connections.h"

#include <algorithm>

#include "serve/connection.h"
#include "serve/limits.h"

namespace mimicry::serve {

bool Connections::add(const std::shared_ptr<Connection>& connection) {
  const std::string& client = connection->client();
  const auto own = of_client_.find(client);
  if ((own == of_client_.end() ? 0 : own->second) >= std::min(most_, limits::kConnectionsOfClient)
          ? !end_longest_waiting(&client)
          : all_.size() >= most_ && !end_longest_waiting())
    return false;
  all_.emplace(connection.get(), connection);
  ++of_client_[client];
  return true;
}

void Connections::remove(Connection& connection) {
  if (all_.erase(&connection) == 0) return;
  const auto count = of_client_.find(connection.client());
  if (--count->second == 0) of_client_.erase(count);
}

Connections::Waiting::iterator Connections::wait(Connection& connection) {
  return waiting_.insert(waiting_.end(), &connection);
}

void Connections::stop_waiting(Waiting::iterator place) {
  waiting_.erase(place);
}

bool Connections::end_longest_waiting(const std::string* client) {
  const auto found = std::find_if(waiting_.begin(), waiting_.end(), [&](const Connection* c) {
    return !client || c->client() == *client;
  });
  if (found == waiting_.end()) return false;
  (*found)->end();
  return true;
}

bool Connections::add_upload(Connection& connection) {
  const std::string& client = connection.client();
  const auto own = static_cast<std::size_t>(
      std::count_if(uploads_.begin(), uploads_.end(),
                    [&](const Connection* c) { return c->client() == client; }));
  if (own >= limits::kUploadsOfClient
          ? !end_slowest_upload(&client)
          : uploads_.size() >= limits::kUploads && !end_slowest_upload(nullptr))
    return false;
  uploads_.push_back(&connection);
  return true;
}

void Connections::remove_upload(Connection& connection) {
  uploads_.remove(&connection);
}

bool Connections::end_slowest_upload(const std::string* client) {
  Connection* slowest = nullptr;
  for (Connection* c : uploads_)
    if ((!client || c->client() == *client) &&
        (!slowest || c->upload_rate() < slowest->upload_rate()))
      slowest = c;
  if (!slowest || slowest->upload_rate() >= limits::kFastBytesPerSecond) return false;
  slowest->end();
  return true;
}

std::list<std::shared_ptr<Connection>> Connections::all() const {
  std::list<std::shared_ptr<Connection>> found;
  for (const auto& [_, weak] : all_)
    if (auto connection = weak.lock()) found.push_back(std::move(connection));
  return found;
}

}  // namespace mimicry::serve
