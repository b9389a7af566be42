#pragma once

#include <memory>
#include <string>

namespace mimicry {

/// Keeps a second program from writing where this one writes. The system gives the lock back when
/// the program ends, however it ends. File systems without locks are used without.
class OutputLock {
 public:
  /// Of a folder, which is made where it is missing, and removed again where nothing came there.
  /// Nothing is written for the lock. Throws Error(io) where another program has it, naming the
  /// folder.
  static OutputLock of_folder(const std::string& folder);
  /// Of one file: `.NAME.lock` stands beside it meanwhile. Throws Error(io) where another program
  /// has it, or where no file can be written there. A device or pipe needs no lock.
  static OutputLock of_file(const std::string& file);

  OutputLock(OutputLock&&) noexcept;
  OutputLock& operator=(OutputLock&&) = delete;
  ~OutputLock();

 private:
  struct Held;
  explicit OutputLock(std::unique_ptr<Held> held);
  std::unique_ptr<Held> held_;
};

}  // namespace mimicry
