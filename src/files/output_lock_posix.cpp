#include <filesystem>
#include <utility>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "files/file.h"
#include "files/names.h"
#include "files/output_lock.h"
#include "files/system.h"
#include "files/unfinished.h"

namespace mimicry {
namespace {

constexpr int kLockFlags = O_RDWR | O_CREAT | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC;

// Takes the lock of an open file. False where the file system has none.
bool take(int file, const std::string& output) {
  if (::flock(file, LOCK_EX | LOCK_NB) == 0) return true;
  if (errno == EWOULDBLOCK) fail_locked(output);
  return false;
}

}  // namespace

struct OutputLock::Held {
  Descriptor file;
  std::string path;  // of the lock's own file; empty: none
  std::unique_ptr<Unfinished> unfinished;
  std::string made;  // the folder, where it was; empty: none

  ~Held() {
    // While the lock is held: whoever waits for this file finds that it has no name any more.
    if (!path.empty()) ::unlink(path.c_str());
    if (!made.empty()) ::rmdir(made.c_str());  // if nothing came there
  }
};

OutputLock::OutputLock(std::unique_ptr<Held> held) : held_(std::move(held)) {}
OutputLock::OutputLock(OutputLock&&) noexcept = default;
OutputLock::~OutputLock() = default;

OutputLock OutputLock::of_folder(const std::string& folder) {
  std::error_code none;
  const bool was_there = std::filesystem::exists(folder, none);
  auto unfinished = was_there ? nullptr : std::make_unique<Unfinished>(folder);
  make_folder(folder);
  if (unfinished) unfinished->made();
  Descriptor file(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (!file) fail(folder, "cannot be opened", errno);
  take(file.get(), folder);
  return OutputLock(std::unique_ptr<Held>(
      new Held{std::move(file), {}, std::move(unfinished), was_there ? std::string() : folder}));
}

OutputLock OutputLock::of_file(const std::string& file) {
  std::error_code none;
  const auto status = std::filesystem::status(file, none);
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
    return OutputLock(nullptr);
  const std::filesystem::path path = to_path(file);
  const std::string name =
      (path.parent_path() / ("." + path.filename().string() + ".lock")).string();
  for (;;) {
    Descriptor lock(::open(name.c_str(), kLockFlags, 0666));
    if (!lock && errno == EINTR) continue;
    if (!lock) fail(file, "cannot be written", errno);
    if (!take(lock.get(), file)) {
      ::unlink(name.c_str());
      return OutputLock(nullptr);
    }
    // The one who had it may have removed the file between our two calls.
    struct stat ours = {}, named = {};
    if (::fstat(lock.get(), &ours) != 0 || ::stat(name.c_str(), &named) != 0 ||
        ours.st_ino != named.st_ino || ours.st_dev != named.st_dev)
      continue;
    auto unfinished = std::make_unique<Unfinished>(name);
    unfinished->made();
    return OutputLock(
        std::unique_ptr<Held>(new Held{std::move(lock), name, std::move(unfinished), {}}));
  }
}

}  // namespace mimicry
