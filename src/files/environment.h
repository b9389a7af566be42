#pragma once

#include <cstdio>
#include <optional>
#include <string>

namespace mimicry {

/// A variable of the program's environment, in UTF-8.
std::optional<std::string> environment(const char* name);

/// Where this user's programs keep what can be made again: XDG_CACHE_HOME or ~/.cache, on Windows
/// LOCALAPPDATA. Empty where there is no such place.
std::string cache_folder();

/// A file opened for reading its bytes, as std::fopen does it for names that are UTF-8.
std::FILE* open_stream(const std::string& path);

}  // namespace mimicry
