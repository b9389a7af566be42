#include "files/names.h"

namespace mimicry {

std::string file_name(const std::string& path) {
  return to_text(to_path(path).filename());
}

std::string file_stem(const std::string& path) {
  return to_text(to_path(path).stem());
}

std::string join_path(const std::string& folder, const std::string& name) {
  return to_text(to_path(folder) / to_path(name));
}

}  // namespace mimicry
