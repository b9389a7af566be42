#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace mimicry::serve {

/// UTF-8 whatever the bytes: U+FFFD stands where they were none, and for control characters.
std::string printable(std::string_view bytes);

/// `%41` becomes `A`; nullopt for a `%` without two hexadecimal digits.
std::optional<std::string> percent_decoded(std::string_view text);

/// A host without its port, in lower case: `[::1]:80` gives `::1`; nullopt where it is none.
std::optional<std::string> host_of(std::string_view authority);

/// {"error": sentence}
std::string error_json(std::string_view sentence);

}  // namespace mimicry::serve
