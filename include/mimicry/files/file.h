#pragma once

#include <string>
#include <string_view>

namespace mimicry::files {

/// All bytes of a file. Throws Error(io) where it cannot be read.
std::string read_file(const std::string& path);

/// The bytes of a file as the system's cache of it holds them: nothing is copied. The file must not
/// be cut short while it is mapped (one that is replaced, as `write_file_atomically` does, stays).
class MappedFile {
 public:
  /// Throws Error(io) where the file cannot be read. What cannot be mapped (a pipe) is read.
  explicit MappedFile(const std::string& path);
  ~MappedFile();
  MappedFile(const MappedFile&) = delete;
  MappedFile& operator=(const MappedFile&) = delete;

  std::string_view bytes() const { return bytes_; }

 private:
  std::string read_;
  std::string_view bytes_;
};

/// Writes a file beside `path`, flushes it to the disk and renames it, so that `path` never holds a
/// part: on failure it is as before and Error(io) is thrown. A symbolic link is followed; a device
/// or pipe is written to directly.
void write_file_atomically(const std::string& path, std::string_view bytes);

}  // namespace mimicry::files
