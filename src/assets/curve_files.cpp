#include <array>
#include <filesystem>
#include <utility>
#include <vector>

#include <mimicry/assets/files.h>
#include <mimicry/base/error.h>

#include "files/file.h"
#include "files/names.h"

namespace mimicry {
namespace {

constexpr double kTubeRadius = 0.003;  // of the mesh's diagonal

using Colors = std::vector<std::array<unsigned char, 3>>;

Colors colors_of(const CurveSet& set) {
  Colors colors;
  for (const CurveRecord& record : set.curves) {
    const TechniqueInfo* technique = technique_named(record.technique);
    const std::uint32_t rgb = technique ? technique->color : TechniqueInfo{}.color;
    const auto byte = [rgb](int shift) { return static_cast<unsigned char>(rgb >> shift & 0xff); };
    colors.push_back({byte(16), byte(8), byte(0)});
  }
  return colors;
}

std::string curve_bytes(const std::string& path, const CurveSet& set, const TriangleMesh& mesh) {
  const std::string ending = to_text(to_path(path).extension());
  if (ending == ".json") return write_curves_json(set, mesh);
  if (ending == ".obj") return write_curves_obj(set, mesh);
  if (ending == ".csv") return write_curves_csv(set, mesh);
  const double radius = kTubeRadius * diagonal(mesh);
  if (ending == ".glb") return write_curves_glb(set, mesh, colors_of(set), radius);
  if (ending == ".ply") return write_curves_ply(set, mesh, colors_of(set), radius);
  throw Error(ErrorKind::unsupported, path + ": '" + ending +
                                          "' is no format of curves; name the file .json, .obj, "
                                          ".csv, .glb or .ply");
}

}  // namespace

CurveRecord curve_record(const Stroke& stroke, const TechniqueInfo& technique, ProjectedCurve curve,
                         const TechniqueOptions& options) {
  CurveRecord record;
  record.stroke = stroke.id;
  record.technique = technique.name;
  for (const OptionInfo& option : technique.options) {
    if (!is_listed(technique, option, options)) continue;
    const auto values = option_value(technique, option, options);
    record.options[option.name] = {values.begin(), values.end()};
  }
  record.model_to_world = stroke.model_to_world;
  record.curve = std::move(curve);
  return record;
}

void save_curves(const std::string& path, const CurveSet& set, const TriangleMesh& mesh) {
  write_file_atomically(path, curve_bytes(path, set, mesh));
}

}  // namespace mimicry
