#include "files/system.h"

#include <system_error>

#include <mimicry/base/error.h>

namespace mimicry {

void fail(const std::string& path, const char* what, int error) {
  throw Error(ErrorKind::io, path + ": " + what + ": " + std::generic_category().message(error) +
                                 "; check the path, the rights and the room left");
}

void fail_kind(const std::string& path, Kind kind) {
  const char* const name = kind == Kind::folder   ? "a folder"
                           : kind == Kind::pipe   ? "a pipe"
                           : kind == Kind::socket ? "a socket"
                                                  : "a device";
  throw Error(ErrorKind::io, path + ": is " + name +
                                 " where a plain file belongs; remove it, or give another place");
}

void fail_locked(const std::string& output) {
  throw Error(ErrorKind::io, output +
                                 ": another program is writing there; wait until it is done, or "
                                 "write to another place");
}

}  // namespace mimicry
