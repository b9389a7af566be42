#pragma once

#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>

namespace mimicry {

// What systems do differently: system_posix.cpp and system_windows.cpp. Paths are UTF-8 (on POSIX
// any bytes). Calls are the system's own and not the C library's streams: an error is known at the
// call that meets it, and no name is opened that would wait for another program. What can fail
// says so by -1, false or null, with errno; a signal that came between is no failure.

void close_file(int file) noexcept;

/// An open file.
class Descriptor {
 public:
  explicit Descriptor(int file = -1) : file_(file) {}
  Descriptor(Descriptor&& other) noexcept : file_(std::exchange(other.file_, -1)) {}
  Descriptor& operator=(Descriptor&&) = delete;
  ~Descriptor() {
    if (file_ >= 0) close_file(file_);
  }
  int get() const { return file_; }
  int release() { return std::exchange(file_, -1); }
  explicit operator bool() const { return file_ >= 0; }
  /// False, with errno, where the system says only now that writing failed.
  bool close();

 private:
  int file_;
};

enum class Kind { none, file, folder, pipe, socket, device, disk };

struct FileStatus {
  Kind kind = Kind::none;
  std::uint64_t size = 0;
};

/// Throws Error(io) that names the path, what failed, the system's reason and the remedy.
[[noreturn]] void fail(const std::string& path, const char* what, int error);
/// For what is there, but is no file.
[[noreturn]] void fail_kind(const std::string& path, Kind kind);
/// Throws Error(io): another program has the lock of this output.
[[noreturn]] void fail_locked(const std::string& output);

enum class Wait { no, for_other_end };  // of a pipe
int open_to_read(const std::string& path, Wait wait);
/// A file that was not there; EEXIST where it was.
int open_new(const std::string& path);
/// To write at its end; made where it is missing.
int open_to_append(const std::string& path);
/// What is no file, to be written to. ENXIO: a pipe that nobody reads.
int open_device(const std::string& path);

bool status_of(int file, FileStatus& status);
/// Of what has this name, behind symbolic links.
Kind kind_of(const std::string& path);
std::ptrdiff_t read_some(int file, char* bytes, std::size_t count);
bool write_all(int file, std::string_view bytes);
bool cut(int file, std::size_t size);
/// Puts a file on the disk.
bool sync(int file);
/// Puts a folder's names on the disk; true where the file system has no such thing.
bool sync_folder_of(const std::string& path);
/// Gives a file another's name, whose content is then gone, in one step.
bool replace(const std::string& from, const std::string& to);
/// May be called where `remove_unfinished` may.
void remove_file(const char* path) noexcept;
/// The same for a folder; one that holds something stays.
void remove_folder(const char* path) noexcept;

/// A file's bytes in memory; null where it cannot be mapped. size: not 0.
const char* map_file(int file, std::size_t size);
void unmap_file(const char* bytes, std::size_t size) noexcept;

unsigned long process_number();
void sleep_ms(int milliseconds) noexcept;
/// Until the program ends.
void wait_for_end() noexcept;

}  // namespace mimicry
