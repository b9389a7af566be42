#include "serve/memory_file.h"

#include <cerrno>
#include <utility>

#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <mimicry/base/error.h>

namespace mimicry::serve {

MemoryFile MemoryFile::make(HeldBytes held) {
  MemoryFile made;
  made.descriptor_ = ::memfd_create("mimicry", MFD_CLOEXEC);
  if (made.descriptor_ < 0)
    throw Error(ErrorKind::io, "there is no memory or file left for a request; try again later");
  made.held_ = std::move(held);
  return made;
}

MemoryFile::~MemoryFile() {
  count(0);
  if (descriptor_ >= 0) ::close(descriptor_);
}

MemoryFile::MemoryFile(MemoryFile&& other) noexcept
    : descriptor_(std::exchange(other.descriptor_, -1)),
      held_(std::move(other.held_)),
      size_(std::exchange(other.size_, 0)) {}

MemoryFile& MemoryFile::operator=(MemoryFile&& other) noexcept {
  std::swap(descriptor_, other.descriptor_);
  std::swap(held_, other.held_);
  std::swap(size_, other.size_);
  return *this;
}

void MemoryFile::count(std::uint64_t size) {
  if (held_) *held_ += size - size_;
  size_ = size;
}

bool MemoryFile::append(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    count(size_ + static_cast<std::uint64_t>(written));
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

std::uint64_t MemoryFile::measure() {
  struct stat status = {};
  if (descriptor_ >= 0 && ::fstat(descriptor_, &status) == 0)
    count(static_cast<std::uint64_t>(status.st_size));
  return size_;
}

std::shared_ptr<const std::string_view> MemoryFile::map(MemoryFile file) {
  const auto size = static_cast<std::size_t>(file.measure());
  if (size == 0) return std::make_shared<const std::string_view>();
  void* const at = ::mmap(nullptr, size, PROT_READ, MAP_SHARED, file.descriptor_, 0);
  if (at == MAP_FAILED) return nullptr;
  const auto kept = std::make_shared<MemoryFile>(std::move(file));
  return {new std::string_view(static_cast<const char*>(at), size),
          [at, size, kept](const std::string_view* view) {
            ::munmap(at, size);
            delete view;
          }};
}

}  // namespace mimicry::serve
