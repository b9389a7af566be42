#include <algorithm>
#include <cmath>
#include <string>

#include <mimicry/base/error.h>
#include <mimicry/paint/brush.h>

namespace mimicry {
namespace {

void require_between(double value, double low, double high, const char* name, const char* range) {
  if (std::isnan(value) || value < low || value > high)
    throw Error(ErrorKind::invalid_input,
                std::string("brush: its ") + name + " is out of range; give " + range);
}

}  // namespace

void require_valid(const Brush& brush) {
  if (std::isnan(brush.radius) || brush.radius <= 0.0)
    throw Error(ErrorKind::invalid_input, "brush: its radius is not above 0; give a length");
  require_between(brush.hardness, 0.0, 1.0, "hardness", "0 to 1");
  require_between(brush.flow, 0.0, 1.0, "flow", "0 to 1");
  require_between(brush.opacity, 0.0, 1.0, "opacity", "0 to 1");
  require_between(brush.spacing, 0.01, 1.0, "spacing", "0.01 to 1");
  require_between(brush.pressure_size, 0.0, 1.0, "pressure_size", "0 to 1");
  require_between(brush.pressure_flow, 0.0, 1.0, "pressure_flow", "0 to 1");
}

double brush_profile(double distance, double hardness) {
  if (distance >= 1.0) return distance > 1.0 || hardness < 1.0 ? 0.0 : 1.0;
  if (distance <= hardness) return 1.0;
  const double t = (distance - hardness) / (1.0 - hardness);
  return 1.0 - t * t * (3.0 - 2.0 * t);
}

double dab_alpha(double flow, double spacing) {
  return 1.0 - std::pow(1.0 - flow, spacing);
}

}  // namespace mimicry
