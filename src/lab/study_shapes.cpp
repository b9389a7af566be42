#include "lab/study_shapes.h"

#include <algorithm>
#include <filesystem>

#include <mimicry/assets/canvas.h>
#include <mimicry/assets/files.h>
#include <mimicry/base/error.h>
#include <mimicry/study/recording.h>
#include <mimicry/study/targets.h>

#include "assets/meshes.h"
#include "files/names.h"
#include "lab/study_numbers.h"

namespace mimicry::lab {
namespace fs = std::filesystem;

StudyShapes::StudyShapes(const StudyShapeOptions& options) : folder_(options.folder) {
  const std::string file = file_name(options.targets);
  set_ = load_target_curves(options.targets);
  for (const std::string& name : options.names)
    if (set_.find(name) == nullptr)
      throw Error(ErrorKind::invalid_input, file + ": has no shape '" + name + "'");
  auto other = static_cast<Index>(kStudyShapes.size());
  for (const TargetShape& shape : set_.shapes) {
    const Index known = number_of_shape(shape.name);
    const Index number = known == kNone ? other++ : known;
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
  return std::string(shape_of_number(number));
}

Target StudyShapes::load(const StudyShape& shape, const Monitor& monitor) const {
  const NamedMesh named = load_mesh(mesh_spec(folder_, shape.shape->name), monitor);
  require_fits(*shape.shape, named.mesh);
  return make_target(named, {}, monitor);
}

TargetCurve with_keypoints(TargetCurve curve, const Target& target, double metres_per_unit) {
  if (curve.keypoints.empty())
    curve.keypoints = keypoints(target.surface(), curve.points, metres_per_unit);
  return curve;
}

Similarity placement(const Target& target, double metres_per_unit, bool z_up) {
  Similarity placed;
  if (z_up) placed.rotation = Quat::FromTwoVectors(Vec3::UnitZ(), Vec3::UnitY());
  placed.scale = metres_per_unit;
  placed.translation =
      Vec3(0.0, 1.2, 0.0) - metres_per_unit * (placed.rotation * target.bounding_box().center());
  return placed;
}

}  // namespace mimicry::lab
