#include "files/system.h"

#include <filesystem>
#include <system_error>

#include <fcntl.h>
#include <sys/stat.h>

#include <mimicry/base/error.h>

namespace mimicry::files {

void fail(const std::string& path, const char* what, int error) {
  throw Error(ErrorKind::io, path + ": " + what + ": " + std::generic_category().message(error) +
                                 "; check the path, the rights and the room left");
}

void fail_kind(const std::string& path, unsigned mode) {
  const char* const kind = S_ISDIR(mode)    ? "a folder"
                           : S_ISFIFO(mode) ? "a pipe"
                           : S_ISSOCK(mode) ? "a socket"
                                            : "a device";
  throw Error(ErrorKind::io, path + ": is " + kind +
                                 " where a plain file belongs; remove it, or give another place");
}

int open_file(const std::string& path, int flags) {
  int file = -1;
  do file = ::open(path.c_str(), flags | O_CLOEXEC, 0666);
  while (file < 0 && errno == EINTR);
  return file;
}

bool write_all(int file, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(file, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written == 0) errno = ENOSPC;
    if (written <= 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

bool sync_folder_of(const std::string& path) {
  const auto parent = std::filesystem::path(path).parent_path();
  const Descriptor folder(open_file(parent.empty() ? "." : parent.string(), O_RDONLY));
  // A folder that may be written to and not read cannot be opened.
  if (!folder) return errno == EACCES;
  return ::fsync(folder.get()) == 0 || errno == EINVAL || errno == ENOTSUP;
}

}  // namespace mimicry::files
