#pragma once

#include <string>

namespace mimicry {

/// A name in a folder that must not outlive the program, of a file or of a folder that is empty:
/// `remove_unfinished` removes it until this is destroyed. Made before the file is. The names stand
/// in fixed memory, where a signal handler may read them; beyond 64 at once, and of 4096 bytes or
/// more, they are not known there.
class Unfinished {
 public:
  explicit Unfinished(const std::string& path);
  ~Unfinished();
  Unfinished(const Unfinished&) = delete;
  Unfinished& operator=(const Unfinished&) = delete;
  /// The file is there.
  void made() noexcept;

 private:
  int slot_ = -1;
};

}  // namespace mimicry
