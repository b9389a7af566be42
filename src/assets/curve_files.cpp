#include "assets/curve_files.h"

#include <filesystem>
#include <string>
#include <utility>

#include <mimicry/assets/files.h>
#include <mimicry/base/error.h>

#include "files/file.h"
#include "files/names.h"

namespace mimicry {

std::vector<std::array<unsigned char, 3>> curve_colors(const CurveSet& set) {
  std::vector<std::array<unsigned char, 3>> colors;
  for (const CurveRecord& record : set.curves) {
    const TechniqueInfo* technique = technique_named(record.technique);
    const std::uint32_t rgb = technique ? technique->color : TechniqueInfo{}.color;
    const auto byte = [rgb](int shift) { return static_cast<unsigned char>(rgb >> shift & 0xff); };
    colors.push_back({byte(16), byte(8), byte(0)});
  }
  return colors;
}

std::optional<CurveFormat> curve_format_of(std::string_view ending) {
  constexpr std::pair<std::string_view, CurveFormat> kEndings[] = {{"json", CurveFormat::json},
                                                                   {"obj", CurveFormat::obj},
                                                                   {"csv", CurveFormat::csv},
                                                                   {"glb", CurveFormat::glb},
                                                                   {"ply", CurveFormat::ply}};
  for (const auto& [known, format] : kEndings)
    if (known == ending) return format;
  return std::nullopt;
}

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
  const std::string ending = to_text(to_path(path).extension());
  const auto format = curve_format_of(ending.empty() ? ending : ending.substr(1));
  if (!format)
    throw Error(ErrorKind::unsupported, path + ": '" + ending +
                                            "' is no format of curves; name the file .json, .obj, "
                                            ".csv, .glb or .ply");
  const auto colors = curve_colors(set);
  write_file_atomically(path,
                        write_curves(*format, set, mesh, {colors, kTubeRadius * diagonal(mesh)}));
}

}  // namespace mimicry
