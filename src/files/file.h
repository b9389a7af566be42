#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace mimicry {

/// What a name may stand for. A file that a user names may be a pipe or a terminal; one that a
/// program finds by its name in a folder may not: opening it could wait forever.
enum class Accept { any, regular };

/// All bytes of a file. Throws Error(io) where it cannot be read, is of a kind that is not
/// accepted, or is a stream of more than 2 GB.
std::string read_file(const std::string& path, Accept accept = Accept::any);

/// The bytes of a file as the system's cache of it holds them: nothing is copied. The file must not
/// be cut short while it is mapped (one that is replaced, as `write_file_atomically` does, stays).
class MappedFile {
 public:
  /// Throws Error(io) where the file cannot be read. What cannot be mapped (a pipe) is read.
  explicit MappedFile(const std::string& path, Accept accept = Accept::any);
  ~MappedFile();
  MappedFile(const MappedFile&) = delete;
  MappedFile& operator=(const MappedFile&) = delete;

  std::string_view bytes() const { return bytes_; }

 private:
  std::string read_;
  std::string_view bytes_;
};

/// Writes a file beside `path`, flushes it to the disk and renames it, so that `path` never holds a
/// part: on failure it is as before and Error(io) is thrown. When this returns the file and its
/// name are on the disk. A symbolic link is followed. A terminal, /dev/null and a pipe that a
/// program reads are written to directly; a pipe that nobody reads and a disk are refused.
void write_file_atomically(const std::string& path, std::string_view bytes);

/// What stands at a path, behind links; `not_found` where nothing does. Throws Error(io) where the
/// system does not say: a folder that may not be searched, a name too long, links in a ring.
std::filesystem::file_status status_of(const std::string& path);

/// Makes a folder and those above it, where they are missing. Throws Error(io).
void make_folder(const std::string& path);

/// Removes what unfinished calls in all threads have written beside, and locks' files; they make no
/// more. For the end of a program that has no time: may be called in a signal handler, and only
/// before `_exit`.
void remove_unfinished() noexcept;

}  // namespace mimicry
