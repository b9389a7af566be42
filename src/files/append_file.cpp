#include <fcntl.h>
#include <sys/stat.h>

#include <mimicry/files/append_file.h>

#include "files/system.h"

namespace mimicry::files {

AppendFile::AppendFile(const std::string& path, std::size_t size)
    : path_(path), size_(size), synced_(size) {
  // Without waiting for the other end of what may be a pipe.
  Descriptor file(open_file(path, O_WRONLY | O_CREAT | O_APPEND | O_NONBLOCK));
  struct stat status = {};
  if (!file) {
    const int error = errno;
    if (::stat(path.c_str(), &status) == 0 && !S_ISREG(status.st_mode))
      fail_kind(path, status.st_mode);
    fail(path, "cannot be written", error);
  }
  if (::fstat(file.get(), &status) != 0) fail(path, "cannot be written", errno);
  if (!S_ISREG(status.st_mode)) fail_kind(path, status.st_mode);
  if (::ftruncate(file.get(), static_cast<off_t>(size)) != 0) fail(path, "cannot be cut", errno);
  if (!sync_folder_of(path)) fail(path, "cannot be written", errno);
  file_ = std::make_unique<Descriptor>(std::move(file));
}

AppendFile::~AppendFile() {
  if (size_ != synced_) (void)!::ftruncate(file_->get(), static_cast<off_t>(synced_));
}

void AppendFile::append(std::string_view bytes) {
  size_ += bytes.size();
  if (!write_all(file_->get(), bytes)) fail(path_, "cannot be written", errno);
}

void AppendFile::sync() {
  if (size_ == synced_) return;
  if (::fsync(file_->get()) != 0) fail(path_, "cannot be written", errno);
  synced_ = size_;
}

}  // namespace mimicry::files
