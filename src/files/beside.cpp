#include "files/beside.h"

#include <algorithm>
#include <filesystem>
#include <system_error>

#include <mimicry/base/error.h>

#include "files/file.h"
#include "files/names.h"
#include "files/system.h"

namespace mimicry {

std::optional<std::string> read_beside(const std::string& path, const std::string& name) {
  namespace fs = std::filesystem;
  std::error_code error;
  const fs::path parent = to_path(path).parent_path();
  const fs::path folder = fs::canonical(parent.empty() ? fs::path(".") : parent, error);
  const fs::path file = error ? fs::path() : fs::canonical(folder / to_path(name), error);
  if (error == std::errc::no_such_file_or_directory || error == std::errc::not_a_directory)
    return std::nullopt;
  if (error)
    throw Error(ErrorKind::io, path + ": its file " + name + " cannot be read: " + error.message());
  if (std::mismatch(folder.begin(), folder.end(), file.begin(), file.end()).first != folder.end())
    throw Error(ErrorKind::unsupported, path + ": its file " + name +
                                            " lies outside of the folder, " + to_text(file) +
                                            "; put a copy beside the mesh");
  if (!fs::is_regular_file(file, error))
    throw Error(ErrorKind::io, path + ": its file " + name + " is not a file; put one there");
  return read_file(to_text(file), Accept::regular);
}

}  // namespace mimicry
