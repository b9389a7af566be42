#pragma once

#include <string>

#include <nlohmann/json.hpp>

namespace mimicry::lab {

using Json = nlohmann::ordered_json;

/// Names that are not UTF-8 have U+FFFD in place of what is wrong. indent: -1 for one line.
inline std::string json_text(const Json& value, int indent) {
  return value.dump(indent, ' ', false, Json::error_handler_t::replace);
}

}  // namespace mimicry::lab
