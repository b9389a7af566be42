#include <cstdlib>

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include "files/environment.h"
#include "files/names.h"
#include "files/system.h"

namespace mimicry {
namespace {

int open_file(const std::string& path, int flags) {
  int file = -1;
  do file = ::open(path.c_str(), flags | O_CLOEXEC, 0666);
  while (file < 0 && errno == EINTR);
  return file;
}

Kind kind_of_mode(mode_t mode) {
  return S_ISREG(mode)    ? Kind::file
         : S_ISDIR(mode)  ? Kind::folder
         : S_ISFIFO(mode) ? Kind::pipe
         : S_ISSOCK(mode) ? Kind::socket
         : S_ISBLK(mode)  ? Kind::disk
                          : Kind::device;
}

}  // namespace

void close_file(int file) noexcept {
  ::close(file);
}

bool Descriptor::close() {
  return ::close(std::exchange(file_, -1)) == 0 || errno == EINTR;
}

int open_to_read(const std::string& path, Wait wait) {
  // With O_NONBLOCK a pipe without a writer opens at once.
  return open_file(path, O_RDONLY | (wait == Wait::no ? O_NONBLOCK : 0));
}

int open_new(const std::string& path) {
  return open_file(path, O_WRONLY | O_CREAT | O_EXCL);
}

int open_to_append(const std::string& path) {
  return open_file(path, O_WRONLY | O_CREAT | O_APPEND | O_NONBLOCK);
}

int open_device(const std::string& path) {
  // Not waiting for a reader who may never come; for one who is slow, later, yes.
  Descriptor file(open_file(path, O_WRONLY | O_NONBLOCK));
  if (!file || ::fcntl(file.get(), F_SETFL, O_WRONLY) != 0) return -1;
  return file.release();
}

bool status_of(int file, FileStatus& status) {
  struct stat found = {};
  if (::fstat(file, &found) != 0) return false;
  status = {kind_of_mode(found.st_mode), static_cast<std::uint64_t>(found.st_size)};
  return true;
}

Kind kind_of(const std::string& path) {
  struct stat found = {};
  return ::stat(path.c_str(), &found) == 0 ? kind_of_mode(found.st_mode) : Kind::none;
}

std::ptrdiff_t read_some(int file, char* bytes, std::size_t count) {
  ssize_t got = 0;
  do got = ::read(file, bytes, count);
  while (got < 0 && errno == EINTR);
  return got;
}

bool write_all(int file, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(file, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written == 0) errno = ENOSPC;
    if (written <= 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

bool cut(int file, std::size_t size) {
  return ::ftruncate(file, static_cast<off_t>(size)) == 0;
}

bool sync(int file) {
  return ::fsync(file) == 0;
}

bool sync_folder_of(const std::string& path) {
  const auto parent = std::filesystem::path(path).parent_path();
  const Descriptor folder(open_file(parent.empty() ? "." : parent.string(), O_RDONLY));
  // A folder that may be written to and not read cannot be opened.
  if (!folder) return errno == EACCES;
  return ::fsync(folder.get()) == 0 || errno == EINVAL || errno == ENOTSUP;
}

bool replace(const std::string& from, const std::string& to) {
  return ::rename(from.c_str(), to.c_str()) == 0;
}

void remove_folder(const char* path) noexcept {
  ::rmdir(path);
}

void remove_file(const char* path) noexcept {
  ::unlink(path);
}

const char* map_file(int file, std::size_t size) {
  void* const map = ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE, file, 0);
  return map == MAP_FAILED ? nullptr : static_cast<const char*>(map);
}

void unmap_file(const char* bytes, std::size_t size) noexcept {
  ::munmap(const_cast<char*>(bytes), size);
}

unsigned long process_number() {
  return static_cast<unsigned long>(::getpid());
}

void sleep_ms(int milliseconds) noexcept {
  const timespec time{milliseconds / 1000, milliseconds % 1000 * 1'000'000L};
  ::nanosleep(&time, nullptr);
}

void wait_for_end() noexcept {
  for (;;) ::pause();
}

std::filesystem::path to_path(const std::string& text) {
  return text;
}

std::string to_text(const std::filesystem::path& path) {
  return path.string();
}

std::FILE* open_stream(const std::string& path) {
  return std::fopen(path.c_str(), "rb");
}

std::optional<std::string> environment(const char* name) {
  const char* const value = std::getenv(name);
  return value ? std::optional<std::string>(value) : std::nullopt;
}

std::string cache_folder() {
  const auto own = environment("XDG_CACHE_HOME"), home = environment("HOME");
  if (own && own->starts_with('/')) return *own;
  return home && !home->empty() ? to_text(to_path(*home) / ".cache") : "";
}

}  // namespace mimicry
