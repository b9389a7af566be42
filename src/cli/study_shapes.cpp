#include "cli/study_shapes.h"

#include <algorithm>
#include <filesystem>

#include <mimicry/base/error.h>
#include <mimicry/files/file.h>
#include <mimicry/io/targets_reader.h>
#include <mimicry/study/protocol.h>

namespace mimicry::cli {
namespace fs = std::filesystem;

std::string mesh_spec(const std::string& folder, const std::string& shape) {
  if (folder.empty()) return "shape:" + shape;
  std::error_code none;
  if (fs::is_regular_file(fs::path(folder) / shape, none))
    return (fs::path(folder) / shape).string();
  return find_mesh_file(folder, shape);
}

void add_study_shape_options(CLI::App& command, StudyShapeOptions& options) {
  command.add_option("--shapes", options.folder,
                     "Folder of the shapes' mesh files (default: the built-in shapes)");
  command.add_option("--targets", options.targets, "File of the shapes' target curves")->required();
  command.add_option("--only", options.names, "Only these shapes")->delimiter(',');
}

StudyShapes::StudyShapes(const StudyShapeOptions& options) : folder_(options.folder) {
  const std::string file = fs::path(options.targets).filename().string();
  set_ = io::read_targets(files::read_file(options.targets), file);
  for (const std::string& name : options.names)
    if (set_.find(name) == nullptr)
      throw Error(ErrorKind::invalid_input, file + ": has no shape '" + name + "'");
  auto other = static_cast<Index>(study::kStudyShapes.size());
  for (const study::TargetShape& shape : set_.shapes) {
    const auto at = std::find(study::kStudyShapes.begin(), study::kStudyShapes.end(), shape.name);
    const Index number = at != study::kStudyShapes.end()
                             ? static_cast<Index>(at - study::kStudyShapes.begin())
                             : other++;
    if (!options.names.empty() &&
        std::find(options.names.begin(), options.names.end(), shape.name) == options.names.end())
      continue;
    list_.push_back({number, &shape});
  }
  std::sort(list_.begin(), list_.end(),
            [](const StudyShape& a, const StudyShape& b) { return a.number < b.number; });
}

const StudyShape* StudyShapes::find(const std::string& name) const {
  for (const StudyShape& entry : list_)
    if (entry.shape->name == name) return &entry;
  return nullptr;
}

std::string StudyShapes::name(Index number) const {
  for (const StudyShape& entry : list_)
    if (entry.number == number) return entry.shape->name;
  return {};
}

spatial::Target StudyShapes::load(const StudyShape& shape) const {
  const NamedMesh named = load_mesh(mesh_spec(folder_, shape.shape->name));
  study::require_fits(*shape.shape, named.mesh);
  return make_target(named);
}

Similarity placement(const spatial::Target& target, double metres_per_unit, bool z_up) {
  Similarity placed;
  if (z_up) placed.rotation = Quat::FromTwoVectors(Vec3::UnitZ(), Vec3::UnitY());
  placed.scale = metres_per_unit;
  placed.translation =
      Vec3(0.0, 1.2, 0.0) - metres_per_unit * (placed.rotation * target.bounding_box().center());
  return placed;
}

}  // namespace mimicry::cli
