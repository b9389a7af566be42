#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "serve/memory_file.h"

namespace mimicry::serve {

/// A request's head as it came over the wire.
struct Head {
  std::string method;
  std::string target;
  bool is_http_1_1 = true;
  std::vector<std::pair<std::string, std::string>> fields;

  /// Of the first field with this name, whatever its case; empty where there is none.
  std::string_view field(std::string_view name) const;
  std::size_t count(std::string_view name) const;
};

/// A request that is fit to be answered.
struct Request {
  Head head;
  std::string path;  ///< decoded, begins with '/', without NUL
  std::map<std::string, std::string> query;
  std::string client;  ///< address
  MemoryFile body;
};

struct Response {
  int status = 200;
  std::vector<std::pair<std::string, std::string>> fields;
  std::string_view body;
  std::shared_ptr<const void> keeper;  ///< of the body's bytes

  static Response text(int status, std::string type, std::string content);
};

/// {"error": sentence}
Response refusal(int status, std::string_view sentence);
/// The same with 503 and the time after which to try again.
Response busy(std::string_view sentence);

/// A request that is being answered, now or later.
class Exchange {
 public:
  virtual ~Exchange() = default;
  Request request;
  /// Called when the client goes away before it is answered. Nobody waits for an answer then.
  std::function<void()> on_leave;
  /// Once.
  virtual void answer(Response response) = 0;
};

/// What is served at a path.
struct Route {
  std::string method, path;
  std::uint64_t largest_body = 0;  ///< 0: a body is refused
  /// Refuses a request before its body is read; may be empty.
  std::function<std::optional<Response>(const Request&)> admit;
  std::function<void(std::shared_ptr<Exchange>)> handle;
};

}  // namespace mimicry::serve
