#include <filesystem>

#include <mimicry/assets/files.h>

#include "files/file.h"
#include "files/names.h"

namespace mimicry {

StrokesFile load_strokes(const std::string& path) {
  return read_strokes(read_file(path), file_name(path));
}

}  // namespace mimicry
