#include <filesystem>

#include <mimicry/assets/files.h>

#include "files/file.h"

namespace mimicry {

StrokesFile load_strokes(const std::string& path) {
  return read_strokes(read_file(path), std::filesystem::path(path).filename().string());
}

}  // namespace mimicry
