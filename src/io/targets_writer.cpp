#include <utility>

#include <mimicry/io/study.h>

#include "io/json_text.h"

namespace mimicry {
namespace {

std::string text(const std::string& value) {
  return JsonText().value(value).text();
}

std::string text(const TargetCurve& curve) {
  JsonText out;
  out.begin('{').key("face").begin('[');
  for (const SurfacePoint& p : curve.points) out.value(p.face);
  out.end(']').key("bary").begin('[');
  for (const SurfacePoint& p : curve.points) out.value(p.bary);
  out.end(']');
  if (curve.parameters) {
    out.key("parameters").begin('{').member("control_points", curve.parameters->control_points);
    out.member("k_G", curve.parameters->k_g).member("k_N_degrees", curve.parameters->k_n_deg);
    out.end('}');
  }
  if (!curve.keypoints.empty()) out.member("keypoints", curve.keypoints);
  out.end('}');
  return out.text();
}

}  // namespace

std::string write_targets(const TargetSet& set, std::string_view note) {
  std::string out = "{\"note\":" + text(std::string(note)) + ",\"shapes\":[";
  const char* before_shape = "\n";
  for (const TargetShape& shape : set.shapes) {
    out += before_shape;
    before_shape = ",\n";
    out += "{\"name\":" + text(shape.name);
    out += ",\"scale\":" + JsonText().value(shape.scale).text() + ",\"curves\":[";
    const char* before_curve = "\n";
    for (const TargetCurve& curve : shape.curves) {
      out += before_curve + text(curve);
      before_curve = ",\n";
    }
    out += "\n]}";
  }
  out += "\n]}\n";
  return out;
}

}  // namespace mimicry
