#include "files/append_file.h"

#include "files/system.h"

namespace mimicry {

AppendFile::AppendFile(const std::string& path, std::size_t size)
    : path_(path), size_(size), synced_(size) {
  Descriptor file(open_to_append(path));
  FileStatus status;
  if (!file) {
    const int error = errno;
    const Kind kind = kind_of(path);
    if (kind != Kind::none && kind != Kind::file) fail_kind(path, kind);
    fail(path, "cannot be written", error);
  }
  if (!status_of(file.get(), status)) fail(path, "cannot be written", errno);
  if (status.kind != Kind::file) fail_kind(path, status.kind);
  if (!cut(file.get(), size)) fail(path, "cannot be cut", errno);
  if (!sync_folder_of(path)) fail(path, "cannot be written", errno);
  file_ = std::make_unique<Descriptor>(std::move(file));
}

AppendFile::~AppendFile() {
  if (size_ != synced_) (void)cut(file_->get(), synced_);
}

void AppendFile::append(std::string_view bytes) {
  size_ += bytes.size();
  if (!write_all(file_->get(), bytes)) fail(path_, "cannot be written", errno);
}

void AppendFile::sync() {
  if (size_ == synced_) return;
  if (!mimicry::sync(file_->get())) fail(path_, "cannot be written", errno);
  synced_ = size_;
}

}  // namespace mimicry
