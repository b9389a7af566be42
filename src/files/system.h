#pragma once

#include <cerrno>
#include <string>
#include <string_view>
#include <utility>

#include <unistd.h>

namespace mimicry::files {

/// An open file. Calls are the system's own and not the C library's streams: an error is known at
/// the call that meets it, and no name is opened that would wait for another program.
class Descriptor {
 public:
  explicit Descriptor(int file = -1) : file_(file) {}
  Descriptor(Descriptor&& other) noexcept : file_(std::exchange(other.file_, -1)) {}
  Descriptor& operator=(Descriptor&&) = delete;
  ~Descriptor() {
    if (file_ >= 0) ::close(file_);
  }
  int get() const { return file_; }
  explicit operator bool() const { return file_ >= 0; }
  /// False, with errno, where the system says only now that writing failed.
  bool close() { return ::close(std::exchange(file_, -1)) == 0 || errno == EINTR; }

 private:
  int file_;
};

/// Throws Error(io) that names the path, what failed, the system's reason and the remedy.
[[noreturn]] void fail(const std::string& path, const char* what, int error);
/// For what is there, but is no file.
[[noreturn]] void fail_kind(const std::string& path, unsigned mode);

/// open(2) again where a signal came between; -1 with errno.
int open_file(const std::string& path, int flags);
/// False, with errno, where not all was written.
bool write_all(int file, std::string_view bytes);
/// Puts a folder's names on the disk; true where the file system has no such thing.
bool sync_folder_of(const std::string& path);

}  // namespace mimicry::files
