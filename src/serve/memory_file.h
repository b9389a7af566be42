#pragma once

#include <cstdint>
#include <memory>
#include <string_view>

namespace mimicry::serve {

/// How many bytes all memory files of a server hold.
using HeldBytes = std::shared_ptr<std::uint64_t>;

/// A file in memory that has no name: a process that is started can be given it. Move only.
class MemoryFile {
 public:
  MemoryFile() = default;
  /// Throws Error(io) where the system has no room for one.
  static MemoryFile make(HeldBytes held);
  ~MemoryFile();
  MemoryFile(MemoryFile&& other) noexcept;
  MemoryFile& operator=(MemoryFile&& other) noexcept;

  int descriptor() const { return descriptor_; }
  bool append(std::string_view bytes);
  /// Asks the system, and counts what another process has written into `held`.
  std::uint64_t measure();

  /// Its bytes, which live as long as the pointer; null where they cannot be mapped. Empty files
  /// give a view of nothing.
  static std::shared_ptr<const std::string_view> map(MemoryFile file);

 private:
  void count(std::uint64_t size);

  int descriptor_ = -1;
  HeldBytes held_;
  std::uint64_t size_ = 0;
};

}  // namespace mimicry::serve
