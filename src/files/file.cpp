#include <filesystem>
#include <memory>
#include <system_error>

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>

#include <mimicry/base/error.h>
#include <mimicry/files/file.h>

#include "files/system.h"
#include "files/unfinished.h"

namespace mimicry::files {
namespace {

constexpr std::size_t kMostStreamed = 2'000'000'000;  // bytes; a device may never end

// A file opened for reading, with what it is.
Descriptor open_to_read(const std::string& path, Accept accept, struct stat& status) {
  // With O_NONBLOCK a pipe without a writer opens at once.
  Descriptor file(open_file(path, O_RDONLY | (accept == Accept::regular ? O_NONBLOCK : 0)));
  if (!file || ::fstat(file.get(), &status) != 0) fail(path, "cannot be opened", errno);
  if (S_ISDIR(status.st_mode)) fail(path, "cannot be read", EISDIR);
  if (accept == Accept::regular && !S_ISREG(status.st_mode)) fail_kind(path, status.st_mode);
  return file;
}

std::string read_all(const std::string& path, const Descriptor& file, const struct stat& status) {
  const bool regular = S_ISREG(status.st_mode);
  std::string bytes;
  if (regular) bytes.reserve(static_cast<std::size_t>(status.st_size));
  char block[1 << 16];
  for (;;) {
    const ssize_t count = ::read(file.get(), block, sizeof(block));
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) fail(path, "cannot be read", errno);
    if (count == 0) return bytes;
    bytes.append(block, static_cast<std::size_t>(count));
    if (!regular && bytes.size() > kMostStreamed)
      throw Error(ErrorKind::io, path + ": gives more than 2 GB; write it to a file first");
  }
}

/// A new file beside the one that is written.
class Part {
 public:
  explicit Part(const std::string& path) {
    // Names of our own: another program's part is never taken for ours.
    const std::string stem = path + ".part" + std::to_string(::getpid()) + "-";
    for (int n = 0;; ++n) {
      name_ = stem + std::to_string(n);
      unfinished_ = std::make_unique<Unfinished>(name_);
      Descriptor file(open_file(name_, O_WRONLY | O_CREAT | O_EXCL));
      const int error = errno;
      if (file) {
        file_ = std::make_unique<Descriptor>(std::move(file));
        break;
      }
      unfinished_.reset();
      if (error != EEXIST || n == 1000) fail(path, "cannot be written", error);
    }
    unfinished_->made();
  }
  ~Part() {
    if (unfinished_) ::unlink(name_.c_str());
  }
  Part(const Part&) = delete;
  Part& operator=(const Part&) = delete;

  // False, with errno, where it did not come to that; the part is then removed.
  bool become(const std::string& path, std::string_view bytes) {
    if (!write_all(file_->get(), bytes) || ::fsync(file_->get()) != 0 || !file_->close() ||
        ::rename(name_.c_str(), path.c_str()) != 0)
      return false;
    unfinished_.reset();
    return true;
  }

 private:
  std::string name_;
  std::unique_ptr<Unfinished> unfinished_;
  std::unique_ptr<Descriptor> file_;
};

void write_directly(const std::string& path, std::string_view bytes) {
  // Not waiting for a reader who may never come.
  Descriptor file(open_file(path, O_WRONLY | O_NONBLOCK));
  if (!file && errno == ENXIO)
    throw Error(ErrorKind::io, path + ": no program reads this pipe; start its reader first");
  struct stat status = {};
  if (!file || ::fstat(file.get(), &status) != 0) fail(path, "cannot be written", errno);
  if (S_ISBLK(status.st_mode)) fail_kind(path, status.st_mode);
  if (::fcntl(file.get(), F_SETFL, O_WRONLY) != 0 || !write_all(file.get(), bytes) || !file.close())
    fail(path, "cannot be written", errno);
}

}  // namespace

std::string read_file(const std::string& path, Accept accept) {
  struct stat status = {};
  const Descriptor file = open_to_read(path, accept, status);
  return read_all(path, file, status);
}

MappedFile::MappedFile(const std::string& path, Accept accept) {
  struct stat status = {};
  const Descriptor file = open_to_read(path, accept, status);
  if (S_ISREG(status.st_mode) && status.st_size > 0) {
    const auto size = static_cast<std::size_t>(status.st_size);
    void* const map = ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE, file.get(), 0);
    if (map != MAP_FAILED) {
      bytes_ = {static_cast<const char*>(map), size};
      return;
    }
  }
  read_ = read_all(path, file, status);
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
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
    return write_directly(path, bytes);
  std::string target = path;
  if (std::filesystem::is_symlink(std::filesystem::symlink_status(path, none)) &&
      std::filesystem::exists(status)) {
    const auto real = std::filesystem::canonical(path, none);
    if (!none) target = real.string();
  }

  Part part(target);
  if (!part.become(target, bytes) || !sync_folder_of(target))
    fail(path, "cannot be written", errno);
}

void make_folder(const std::string& path) {
  std::error_code trouble;
  std::filesystem::create_directories(path, trouble);
  // It does not mind a file at the end of the path.
  if (!trouble && !std::filesystem::is_directory(path))
    trouble = {ENOTDIR, std::generic_category()};
  if (trouble)
    throw Error(ErrorKind::io, path + ": the folder cannot be made: " + trouble.message() +
                                   "; check the path, the rights and the room left");
}

}  // namespace mimicry::files
