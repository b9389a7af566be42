#include "cli/target_curves.h"

#include <filesystem>

#include <mimicry/base/error.h>
#include <mimicry/files/file.h>
#include <mimicry/io/targets_reader.h>

namespace mimicry::cli {

study::TargetSet load_targets(const std::string& path) {
  return io::read_targets(files::read_file(path), std::filesystem::path(path).filename().string());
}

const study::TargetShape& find_target_shape(const study::TargetSet& set, const std::string& name,
                                            const std::string& file) {
  if (const study::TargetShape* shape = set.find(name)) return *shape;
  std::string names;
  for (const auto& s : set.shapes) names += (names.empty() ? "" : ", ") + s.name;
  throw Error(ErrorKind::invalid_input,
              file + ": has no shape '" + name + "', only " + names + "; name one with --shape");
}

}  // namespace mimicry::cli
