#include <algorithm>
#include <array>
#include <cmath>

#include <mimicry/io/curves.h>

#include "capi/handles.h"

using namespace mimicry;
using namespace mimicry::capi;

struct mimicry_curve_list {
  std::shared_ptr<const Target> target;
  std::vector<CurveRecord> records;
};

namespace {

using Color = std::array<unsigned char, 3>;

void require_tubes(const CurveSet& set, double radius) {
  const bool all_have = std::all_of(set.curves.begin(), set.curves.end(),
                                    [](const CurveRecord& r) { return !r.radii.empty(); });
  if (!all_have && (!std::isfinite(radius) || radius <= 0.0))
    throw Error(ErrorKind::invalid_input, "the tubes' radius is not above 0");
}

std::string file_bytes(mimicry_curve_format format, const CurveSet& set, const TriangleMesh& mesh,
                       const std::vector<Color>& colors, double radius) {
  switch (format) {
    case MIMICRY_CURVES_JSON:
      return write_curves_json(set, mesh);
    case MIMICRY_CURVES_OBJ:
      return write_curves_obj(set, mesh);
    case MIMICRY_CURVES_CSV:
      return write_curves_csv(set, mesh);
    case MIMICRY_CURVES_PLY:
      require_tubes(set, radius);
      return write_curves_ply(set, mesh, colors, radius);
    case MIMICRY_CURVES_GLB:
      require_tubes(set, radius);
      return write_curves_glb(set, mesh, colors, radius);
    case MIMICRY_CURVES_OBJ_POLYLINES:
      return write_curves_obj(set, mesh, ObjLines::polylines);
    case MIMICRY_CURVES_PLY_LINES:
      return write_curves_ply_lines(set, mesh, colors);
    case MIMICRY_CURVES_GLB_LINES:
      return write_curves_glb_lines(set, mesh, colors);
    case MIMICRY_CURVES_PACKED:
      return write_curves_packed(set, mesh);
  }
  throw Error(ErrorKind::invalid_input,
              "there is no curve format " + std::to_string(static_cast<int>(format)));
}

}  // namespace

mimicry_status mimicry_curves_write(const mimicry_target* target, const char* target_name,
                                    const mimicry_curve* const* curves, size_t count,
                                    mimicry_curve_format format, const uint8_t* colors,
                                    double tube_radius, mimicry_bytes** out) {
  return made(out, [&] {
    require(target, "target");
    if (count > 0) require(curves, "curves");
    CurveSet set{std::string(text(target_name, "target_name")), {}};
    std::vector<Color> chosen(count, Color{});
    for (size_t i = 0; i < count; ++i) {
      require(curves[i], "a curve");
      if (curves[i]->target != target->target)
        throw Error(ErrorKind::invalid_input,
                    "curve " + std::to_string(i) + " is of another target; write a file for each");
      set.curves.push_back(curves[i]->record);
      if (colors) std::copy_n(colors + 3 * i, 3, chosen[i].begin());
    }
    return mimicry_bytes{file_bytes(format, set, target->target->mesh(), chosen, tube_radius)};
  });
}

mimicry_status mimicry_curves_read(const mimicry_target* target, const void* data, size_t size,
                                   const char* name, mimicry_curve_list** out) {
  return made(out, [&] {
    require(target, "target");
    const std::string_view bytes = content(data, size);
    CurveSet set = (is_packed_curves(bytes) ? read_curves_packed : read_curves_json)(
        bytes, text(name, "name"), target->target->mesh());
    return mimicry_curve_list{target->target, std::move(set.curves)};
  });
}

size_t mimicry_curve_list_count(const mimicry_curve_list* list) {
  return list ? list->records.size() : 0;
}

mimicry_status mimicry_curve_list_get(const mimicry_curve_list* list, size_t number,
                                      mimicry_curve** out) {
  return made(out, [&] {
    require(list, "list");
    if (number >= list->records.size())
      throw Error(ErrorKind::invalid_input, "curve " + std::to_string(number) + " of a list of " +
                                                std::to_string(list->records.size()));
    return make_curve(list->target, list->records[number]);
  });
}

void mimicry_curve_list_destroy(mimicry_curve_list* list) {
  delete list;
}
