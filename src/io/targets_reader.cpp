#include <cmath>
#include <cstddef>
#include <string>
#include <utility>

#include <mimicry/io/study.h>

#include "io/json.h"
#include "io/json_document.h"
#include "io/text.h"

namespace mimicry {
namespace {

constexpr double kPublishedRounding = 1e-3;  // the published ones are off by up to 8e-5

SurfacePoint read_point(const Json& face, const Json& bary, const std::string& where) {
  SurfacePoint p{index(face, where), vector<3>(bary, where)};
  if (p.bary.minCoeff() < -kPublishedRounding || std::abs(p.bary.sum() - 1) > kPublishedRounding)
    json_fail(where, "barycentric coordinates are negative or do not sum to 1");
  p.bary = p.bary.cwiseMax(0.0);
  p.bary /= p.bary.sum();
  return p;
}

TargetCurve read_curve(const Json& value, const std::string& where) {
  TargetCurve curve;
  const Json& faces = array(value, "face", where);
  const Json& bary = array(value, "bary", where);
  if (faces.size() != bary.size())
    json_fail(where, "'face' has " + std::to_string(faces.size()) + " entries, 'bary' " +
                         std::to_string(bary.size()));
  curve.points.reserve(faces.size());
  for (std::size_t i = 0; i < faces.size(); ++i)
    curve.points.push_back(read_point(faces[i], bary[i], where + ": point " + std::to_string(i)));
  if (value.contains("parameters") && value["parameters"].contains("k_G")) {
    const Json& given = value["parameters"];
    const std::string place = where + ": parameters";
    curve.parameters = {index(member(given, "control_points", place), place + ": control_points"),
                        number(given["k_G"], place + ": k_G"),
                        number(member(given, "k_N_degrees", place), place + ": k_N_degrees")};
  }
  if (!value.contains("keypoints")) return curve;
  Index previous = kNone;
  for (const Json& entry : array(value, "keypoints", where)) {
    const Index keypoint = index(entry, where + ": keypoints");
    if (keypoint <= previous || static_cast<std::size_t>(keypoint) >= curve.points.size())
      json_fail(where, "keypoint " + std::to_string(keypoint) +
                           " does not increase or lies beyond the curve's points");
    curve.keypoints.push_back(keypoint);
    previous = keypoint;
  }
  return curve;
}

TargetShape read_shape(const Json& value, std::string where) {
  TargetShape shape;
  shape.name = text(member(value, "name", where), where + ": name");
  where += " (" + shape.name + ")";
  shape.scale = number(member(value, "scale", where), where + ": scale");
  if (!(shape.scale > 0)) json_fail(where, "'scale' is not positive");
  const Json& curves = array(value, "curves", where);
  for (std::size_t i = 0; i < curves.size(); ++i)
    shape.curves.push_back(read_curve(curves[i], where + ": curve " + std::to_string(i)));
  return shape;
}

}  // namespace

TargetSet read_targets(std::string_view bytes, std::string_view name) {
  const std::string file(name);
  TargetSet set;
  try {
    const JsonDocument document(text_of(bytes, name), name);
    const Json& shapes = array(document.root(), "shapes", file);
    for (std::size_t i = 0; i < shapes.size(); ++i)
      set.shapes.push_back(read_shape(shapes[i], file + ": shape " + std::to_string(i)));
  } catch (const Json::parse_error& error) {
    throw Error(ErrorKind::invalid_input, file + ": the text ends early or is not JSON at byte " +
                                              std::to_string(error.byte) +
                                              "; fetch the file again");
  } catch (const Json::exception& error) {
    throw Error(ErrorKind::invalid_input, file + ": " + error.what());
  }
  return set;
}

}  // namespace mimicry
