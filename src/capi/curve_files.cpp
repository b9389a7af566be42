#include <algorithm>
#include <array>

#include <mimicry/io/curves.h>

#include "capi/handles.h"
#include "io/curve_formats.h"

using namespace mimicry;
using namespace mimicry::capi;

struct mimicry_curve_list {
  std::shared_ptr<const Target> target;
  std::vector<CurveRecord> records;
};

namespace {

using Color = std::array<unsigned char, 3>;

CurveFormat format_of(mimicry_curve_format format) {
  const int number = static_cast<int>(format);
  if (number < 0 || number >= kCurveFormats)
    throw Error(ErrorKind::invalid_input, "there is no curve format " + std::to_string(number));
  return static_cast<CurveFormat>(number);
}

static_assert(static_cast<int>(CurveFormat::json) == MIMICRY_CURVES_JSON &&
              static_cast<int>(CurveFormat::obj) == MIMICRY_CURVES_OBJ &&
              static_cast<int>(CurveFormat::csv) == MIMICRY_CURVES_CSV &&
              static_cast<int>(CurveFormat::ply) == MIMICRY_CURVES_PLY &&
              static_cast<int>(CurveFormat::glb) == MIMICRY_CURVES_GLB &&
              static_cast<int>(CurveFormat::obj_polylines) == MIMICRY_CURVES_OBJ_POLYLINES &&
              static_cast<int>(CurveFormat::ply_lines) == MIMICRY_CURVES_PLY_LINES &&
              static_cast<int>(CurveFormat::glb_lines) == MIMICRY_CURVES_GLB_LINES &&
              static_cast<int>(CurveFormat::packed) == MIMICRY_CURVES_PACKED &&
              kCurveFormats == MIMICRY_CURVES_PACKED + 1);

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
    return mimicry_bytes{
        write_curves(format_of(format), set, target->target->mesh(), {chosen, tube_radius})};
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
