#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace mimicry {

/// Whether it holds its own bytes (RFC 2397).
bool is_data_uri(std::string_view uri);
/// The bytes that it holds, in base64 (blanks and the alphabet for URLs are fine) or
/// percent-encoded; nullopt where it is neither.
std::optional<std::string> data_of_uri(std::string_view uri);

/// %41 is A; a % that no two digits follow stays.
std::string percent_decoded(std::string_view text);

/// The plain relative name of a file in this folder or in one below it: "./a/../b.bin" is "b.bin".
/// nullopt where it leads out ("..", "/x"), has a scheme or drive ("https:", "C:"), a backslash or
/// a control character, or is empty.
std::optional<std::string> name_below(std::string_view path);

}  // namespace mimicry
