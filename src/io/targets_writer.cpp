#include <utility>

#include <mimicry/io/targets_writer.h>

#include "io/json.h"

namespace mimicry::io {
namespace {

OrderedJson curve_json(const study::TargetCurve& curve) {
  OrderedJson faces = OrderedJson::array();
  OrderedJson bary = OrderedJson::array();
  for (const SurfacePoint& p : curve.points) {
    faces.push_back(p.face);
    bary.push_back(array_of(p.bary));
  }
  OrderedJson value = {{"face", std::move(faces)}, {"bary", std::move(bary)}};
  if (curve.parameters)
    value["parameters"] = {{"control_points", curve.parameters->control_points},
                           {"k_G", curve.parameters->k_g},
                           {"k_N_degrees", curve.parameters->k_n_deg}};
  if (!curve.keypoints.empty()) value["keypoints"] = curve.keypoints;
  return value;
}

}  // namespace

std::string write_targets(const study::TargetSet& set, std::string_view note) {
  const auto text = [](const OrderedJson& value) {
    return value.dump(-1, ' ', false, OrderedJson::error_handler_t::replace);
  };
  std::string out = "{\"note\":" + text(std::string(note)) + ",\"shapes\":[";
  const char* before_shape = "\n";
  for (const study::TargetShape& shape : set.shapes) {
    out += before_shape;
    before_shape = ",\n";
    out += "{\"name\":" + text(shape.name) + ",\"scale\":" + text(shape.scale) + ",\"curves\":[";
    const char* before_curve = "\n";
    for (const study::TargetCurve& curve : shape.curves) {
      out += before_curve + text(curve_json(curve));
      before_curve = ",\n";
    }
    out += "\n]}";
  }
  return out + "\n]}\n";
}

}  // namespace mimicry::io
