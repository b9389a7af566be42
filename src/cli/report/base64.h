#pragma once

#include <string>
#include <string_view>

namespace mimicry::cli {

/// RFC 4648, padded.
std::string base64(std::string_view bytes);

}  // namespace mimicry::cli
