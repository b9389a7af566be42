#pragma once

#include <optional>
#include <string>

namespace mimicry {

/// The content of the file `name` in the folder of the file `path`, or in a folder below that one;
/// nullopt where there is none. Throws Error(unsupported) where it lies elsewhere once symbolic
/// links are followed, Error(io) where it is no regular file or cannot be read.
std::optional<std::string> read_beside(const std::string& path, const std::string& name);

}  // namespace mimicry
