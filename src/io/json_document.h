#pragma once

#include <functional>
#include <string_view>

#include "io/json.h"

namespace mimicry {

/// More arrays and objects in each other than these are refused.
inline constexpr int kMostNested = 1000;

/// Is told of each key, value, and beginning and end of an array or object while a text is parsed,
/// with how many are open around it. Where it returns false the value that ended is not kept.
using JsonEvent = std::function<bool(int depth, Json::parse_event_t event, Json& value)>;

/// A parsed text. Where memory ends while it is made or after, `std::bad_alloc` leaves it: giving
/// it back takes none. (Json's own destructor allocates, and would end the program.)
class JsonDocument {
 public:
  JsonDocument() = default;
  /// name: of the file, for the error where the text is nested too deep. Throws Json::parse_error
  /// and Json::out_of_range (a number beyond a double) as Json::parse, and what `event` throws.
  JsonDocument(std::string_view text, std::string_view name, const JsonEvent& event = {});
  JsonDocument(JsonDocument&& other) noexcept { std::swap(root_, other.root_); }
  JsonDocument& operator=(JsonDocument&& other) noexcept {
    std::swap(root_, other.root_);
    return *this;
  }
  ~JsonDocument();

  const Json& root() const { return root_; }

 private:
  Json root_;
};

}  // namespace mimicry
