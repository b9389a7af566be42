#pragma once

#include <string>
#include <string_view>

namespace mimicry::files {

/// All bytes of a file. Throws Error(io) where it cannot be read.
std::string read_file(const std::string& path);

/// Writes a file beside `path`, flushes it to the disk and renames it, so that `path` never holds a
/// part: on failure it is as before and Error(io) is thrown. A symbolic link is followed; a device
/// or pipe is written to directly.
void write_file_atomically(const std::string& path, std::string_view bytes);

}  // namespace mimicry::files
