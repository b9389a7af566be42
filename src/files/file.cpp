#include "files/file.h"

#include <filesystem>
#include <memory>
#include <system_error>

#include <mimicry/base/error.h>

#include "files/names.h"
#include "files/system.h"
#include "files/unfinished.h"

namespace mimicry {
namespace {

constexpr std::size_t kMostStreamed = 2'000'000'000;  // bytes; a device may never end

// A file opened for reading, with what it is.
Descriptor open_accepted(const std::string& path, Accept accept, FileStatus& status) {
  Descriptor file(open_to_read(path, accept == Accept::regular ? Wait::no : Wait::for_other_end));
  if (!file || !status_of(file.get(), status)) fail(path, "cannot be opened", errno);
  if (status.kind == Kind::folder) fail(path, "cannot be read", EISDIR);
  if (accept == Accept::regular && status.kind != Kind::file) fail_kind(path, status.kind);
  return file;
}

std::string read_all(const std::string& path, const Descriptor& file, const FileStatus& status) {
  const bool regular = status.kind == Kind::file;
  std::string bytes;
  if (regular) bytes.reserve(static_cast<std::size_t>(status.size));
  char block[1 << 16];
  for (;;) {
    const std::ptrdiff_t count = read_some(file.get(), block, sizeof(block));
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
    const std::string stem = path + ".part" + std::to_string(process_number()) + "-";
    for (int n = 0;; ++n) {
      name_ = stem + std::to_string(n);
      unfinished_ = std::make_unique<Unfinished>(name_);
      Descriptor file(open_new(name_));
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
    if (unfinished_) remove_file(name_.c_str());
  }
  Part(const Part&) = delete;
  Part& operator=(const Part&) = delete;

  // False, with errno, where it did not come to that; the part is then removed.
  bool become(const std::string& path, std::string_view bytes) {
    if (!write_all(file_->get(), bytes) || !sync(file_->get()) || !file_->close() ||
        !replace(name_, path))
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
  Descriptor file(open_device(path));
  if (!file && errno == ENXIO)
    throw Error(ErrorKind::io, path + ": no program reads this pipe; start its reader first");
  if (!file || !write_all(file.get(), bytes) || !file.close())
    fail(path, "cannot be written", errno);
}

}  // namespace

std::string read_file(const std::string& path, Accept accept) {
  FileStatus status;
  const Descriptor file = open_accepted(path, accept, status);
  return read_all(path, file, status);
}

MappedFile::MappedFile(const std::string& path, Accept accept) {
  FileStatus status;
  const Descriptor file = open_accepted(path, accept, status);
  if (status.kind == Kind::file && status.size > 0) {
    const auto size = static_cast<std::size_t>(status.size);
    if (const char* const map = map_file(file.get(), size)) {
      bytes_ = {map, size};
      return;
    }
  }
  read_ = read_all(path, file, status);
  bytes_ = read_;
}

MappedFile::~MappedFile() {
  if (bytes_.data() == read_.data()) return;
  unmap_file(bytes_.data(), bytes_.size());
}

void write_file_atomically(const std::string& path, std::string_view bytes) {
  const Kind kind = kind_of(path);
  if (kind == Kind::folder) fail(path, "cannot be written", EISDIR);
  if (kind == Kind::disk) fail_kind(path, kind);
  if (kind != Kind::none && kind != Kind::file) return write_directly(path, bytes);
  std::string target = path;
  std::error_code none;
  const std::filesystem::path name = to_path(path);
  if (kind == Kind::file &&
      std::filesystem::is_symlink(std::filesystem::symlink_status(name, none))) {
    const auto real = std::filesystem::canonical(name, none);
    if (!none) target = to_text(real);
  }

  Part part(target);
  if (!part.become(target, bytes) || !sync_folder_of(target))
    fail(path, "cannot be written", errno);
}

std::filesystem::file_status status_of(const std::string& path) {
  std::error_code trouble;
  const auto status = std::filesystem::status(to_path(path), trouble);
  if (!std::filesystem::status_known(status))
    throw Error(ErrorKind::io, path + ": cannot be looked at: " + trouble.message() +
                                   "; check the path and the rights of its folders");
  return status;
}

void make_folder(const std::string& path) {
  std::error_code trouble;
  const std::filesystem::path folder = to_path(path);
  std::filesystem::create_directories(folder, trouble);
  // It does not mind a file at the end of the path.
  if (!trouble && !std::filesystem::is_directory(folder, trouble) && !trouble)
    trouble = {ENOTDIR, std::generic_category()};
  if (trouble)
    throw Error(ErrorKind::io, path + ": the folder cannot be made: " + trouble.message() +
                                   "; check the path, the rights and the room left");
}

}  // namespace mimicry
