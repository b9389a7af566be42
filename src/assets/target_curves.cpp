#include "assets/target_curves.h"

#include <filesystem>

#include <mimicry/base/error.h>
#include <mimicry/io/study.h>

#include "files/file.h"
#include "files/names.h"

namespace mimicry {

TargetSet load_target_curves(const std::string& path) {
  return read_targets(read_file(path), file_name(path));
}

const TargetShape& find_target_shape(const TargetSet& set, const std::string& name,
                                     const std::string& file) {
  if (const TargetShape* shape = set.find(name)) return *shape;
  std::string names;
  for (const auto& s : set.shapes) names += (names.empty() ? "" : ", ") + s.name;
  throw Error(ErrorKind::invalid_input,
              file + ": has no shape '" + name + "', only " + names + "; name one with --shape");
}

}  // namespace mimicry
