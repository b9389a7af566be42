#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace mimicry {

/// UTF-16 of UTF-8 and back; what is wrong becomes U+FFFD.
std::wstring to_wide(std::string_view text);
std::string to_utf8(std::wstring_view text);
/// A path as the system's calls take it: of any length.
std::wstring system_path(const std::string& path);
/// Sets errno from the system's last error.
void set_errno(unsigned long error);

}  // namespace mimicry
