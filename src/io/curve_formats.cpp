#include "io/curve_formats.h"

#include <algorithm>
#include <cmath>

#include <mimicry/base/error.h>

namespace mimicry {
namespace {

void require_tubes(const CurveSet& set, double radius) {
  const bool all_have = std::all_of(set.curves.begin(), set.curves.end(),
                                    [](const CurveRecord& r) { return !r.radii.empty(); });
  if (!all_have && (!std::isfinite(radius) || radius <= 0.0))
    throw Error(ErrorKind::invalid_input, "the tubes' radius is not above 0");
}

}  // namespace

std::string write_curves(CurveFormat format, const CurveSet& set, const TriangleMesh& mesh,
                         const CurveLook& look) {
  switch (format) {
    case CurveFormat::json:
      return write_curves_json(set, mesh);
    case CurveFormat::obj:
      return write_curves_obj(set, mesh);
    case CurveFormat::csv:
      return write_curves_csv(set, mesh);
    case CurveFormat::ply:
      require_tubes(set, look.radius);
      return write_curves_ply(set, mesh, look.colors, look.radius);
    case CurveFormat::glb:
      require_tubes(set, look.radius);
      return write_curves_glb(set, mesh, look.colors, look.radius);
    case CurveFormat::obj_polylines:
      return write_curves_obj(set, mesh, ObjLines::polylines);
    case CurveFormat::ply_lines:
      return write_curves_ply_lines(set, mesh, look.colors);
    case CurveFormat::glb_lines:
      return write_curves_glb_lines(set, mesh, look.colors);
    case CurveFormat::packed:
      break;
  }
  return write_curves_packed(set, mesh);
}

}  // namespace mimicry
