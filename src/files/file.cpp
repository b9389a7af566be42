#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <system_error>

#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <mimicry/base/error.h>
#include <mimicry/files/file.h>

namespace mimicry::files {
namespace {

struct Close {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, Close>;

[[noreturn]] void fail(const std::string& path, const char* what, int error) {
  throw Error(ErrorKind::io, path + ": " + what + ": " + std::generic_category().message(error) +
                                 "; check the path, the rights and the room left");
}

bool write_all(std::FILE* file, std::string_view bytes) {
  return std::fwrite(bytes.data(), 1, bytes.size(), file) == bytes.size() && std::fflush(file) == 0;
}

/// Creates a file beside `path` that did not exist.
File create_beside(const std::string& path, std::string& part) {
  for (int n = 0;; ++n) {
    part = path + ".part" + std::to_string(n);
    File file(std::fopen(part.c_str(), "wbx"));
    if (file) return file;
    if (errno != EEXIST || n == 1000) fail(path, "cannot be written", errno);
  }
}

}  // namespace

std::string read_file(const std::string& path) {
  const File file(std::fopen(path.c_str(), "rb"));
  if (!file) fail(path, "cannot be opened", errno);
  std::string bytes;
  char block[1 << 16];
  while (const std::size_t count = std::fread(block, 1, sizeof(block), file.get()))
    bytes.append(block, count);
  if (std::ferror(file.get())) fail(path, "cannot be read", errno);
  return bytes;
}

MappedFile::MappedFile(const std::string& path) {
  const File file(std::fopen(path.c_str(), "rb"));
  if (!file) fail(path, "cannot be opened", errno);
  struct stat status = {};
  if (::fstat(::fileno(file.get()), &status) == 0 && S_ISREG(status.st_mode) &&
      status.st_size > 0) {
    const auto size = static_cast<std::size_t>(status.st_size);
    void* const map = ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE, ::fileno(file.get()), 0);
    if (map != MAP_FAILED) {
      bytes_ = {static_cast<const char*>(map), size};
      return;
    }
  }
  read_ = read_file(path);
  bytes_ = read_;
}

MappedFile::~MappedFile() {
  if (bytes_.data() == read_.data()) return;
  ::munmap(const_cast<char*>(bytes_.data()), bytes_.size());
}

void write_file_atomically(const std::string& path, std::string_view bytes) {
  std::error_code none;
  const auto status = std::filesystem::status(path, none);
  if (std::filesystem::is_directory(status)) fail(path, "cannot be written", EISDIR);
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) {
    const File file(std::fopen(path.c_str(), "wb"));
    if (!file || !write_all(file.get(), bytes)) fail(path, "cannot be written", errno);
    return;
  }
  std::string target = path;
  if (std::filesystem::is_symlink(std::filesystem::symlink_status(path, none)) &&
      std::filesystem::exists(status))
    target = std::filesystem::canonical(path).string();

  std::string part;
  File file = create_beside(target, part);
  bool written = write_all(file.get(), bytes) && ::fsync(::fileno(file.get())) == 0;
  int error = errno;
  if (std::fclose(file.release()) != 0 && written) {
    written = false;
    error = errno;
  }
  if (written && std::rename(part.c_str(), target.c_str()) != 0) {
    written = false;
    error = errno;
  }
  if (!written) {
    std::remove(part.c_str());
    fail(path, "cannot be written", error);
  }
}

}  // namespace mimicry::files
