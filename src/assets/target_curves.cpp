#include "assets/target_curves.h"

#include <filesystem>

#include <mimicry/base/error.h>
#include <mimicry/io/study.h>

#include "base/comma_list.h"
#include "files/file.h"
#include "files/names.h"

namespace mimicry {

TargetSet load_target_curves(const std::string& path) {
  return read_targets(read_file(path), file_name(path));
}

const TargetShape& find_target_shape(const TargetSet& set, const std::string& name,
                                     const std::string& file) {
  if (const TargetShape* shape = set.find(name)) return *shape;
  const std::string names = comma_list(set.shapes, [](const auto& s) { return s.name; });
  throw Error(ErrorKind::invalid_input,
              file + ": has no shape '" + name + "', only " + names + "; name one with --shape");
}

}  // namespace mimicry
