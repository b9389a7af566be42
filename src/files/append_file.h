#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>

namespace mimicry {

class Descriptor;

/// A file that grows at its end, opened for a long run. Errors are Error(io).
class AppendFile {
 public:
  /// Opens or makes a file and cuts it to its first `size` bytes. Refuses what is not a plain file.
  AppendFile(const std::string& path, std::size_t size);
  /// Cuts off what was appended since the last `sync`, as far as the system lets it.
  ~AppendFile();
  AppendFile(const AppendFile&) = delete;
  AppendFile& operator=(const AppendFile&) = delete;

  const std::string& path() const { return path_; }
  std::size_t size() const { return size_; }
  void append(std::string_view bytes);
  /// When this returns, all that was appended is on the disk.
  void sync();

 private:
  std::string path_;
  std::unique_ptr<Descriptor> file_;
  std::size_t size_ = 0, synced_ = 0;
};

}  // namespace mimicry
