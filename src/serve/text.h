#pragma once

#include <cstdint>
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

/// With ASCII letters in lower case.
std::string lower(std::string_view text);

/// "1.5 MB", of 1024 times 1024 bytes.
std::string megabytes(std::uint64_t bytes);

/// {"error": sentence}
std::string error_json(std::string_view sentence);

}  // namespace mimicry::serve
