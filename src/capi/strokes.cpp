#include <mimicry/io/strokes.h>

#include "capi/handles.h"

using namespace mimicry;
using namespace mimicry::capi;

mimicry_status mimicry_strokes_create(mimicry_strokes** out) {
  return made(out, [] { return mimicry_strokes{}; });
}

mimicry_status mimicry_strokes_read(const void* data, size_t size, const char* name,
                                    mimicry_strokes** out) {
  return made(out, [&] {
    StrokesFile file = read_strokes(content(data, size), text(name, "name"));
    return mimicry_strokes{std::move(file.strokes), std::move(file.left_out)};
  });
}

mimicry_status mimicry_strokes_append(mimicry_strokes* strokes, const char* id,
                                      const char* target_name,
                                      const mimicry_similarity* model_to_world,
                                      const mimicry_frame* frames, size_t count) {
  return guarded([&] {
    require(strokes, "strokes");
    Stroke s = to_stroke(model_to_world, frames, count);
    s.id = text(id, "id");
    s.target = text(target_name, "target_name");
    strokes->strokes.push_back(std::move(s));
  });
}

mimicry_status mimicry_strokes_write(const mimicry_strokes* strokes, mimicry_bytes** out) {
  return made(out, [&] {
    require(strokes, "strokes");
    return mimicry_bytes{write_strokes(strokes->strokes)};
  });
}

size_t mimicry_strokes_left_out_count(const mimicry_strokes* strokes) {
  return strokes ? strokes->left_out.size() : 0;
}
const char* mimicry_strokes_left_out(const mimicry_strokes* strokes, size_t number) {
  return number < mimicry_strokes_left_out_count(strokes) ? strokes->left_out[number].c_str()
                                                          : nullptr;
}

size_t mimicry_strokes_count(const mimicry_strokes* strokes) {
  return strokes ? strokes->strokes.size() : 0;
}
const char* mimicry_strokes_id(const mimicry_strokes* strokes, size_t number) {
  return number < mimicry_strokes_count(strokes) ? strokes->strokes[number].id.c_str() : nullptr;
}
const char* mimicry_strokes_target(const mimicry_strokes* strokes, size_t number) {
  return number < mimicry_strokes_count(strokes) ? strokes->strokes[number].target.c_str()
                                                 : nullptr;
}
size_t mimicry_strokes_frame_count(const mimicry_strokes* strokes, size_t number) {
  return number < mimicry_strokes_count(strokes) ? strokes->strokes[number].frames.size() : 0;
}

mimicry_status mimicry_strokes_placement(const mimicry_strokes* strokes, size_t number,
                                         mimicry_similarity* out) {
  return guarded([&] {
    require(strokes, "strokes");
    require(out, "out");
    *out = from_similarity(strokes->at(number).model_to_world);
  });
}

mimicry_status mimicry_strokes_frames(const mimicry_strokes* strokes, size_t number,
                                      mimicry_frame* frames) {
  return guarded([&] {
    require(strokes, "strokes");
    const Stroke& s = strokes->at(number);
    if (!s.frames.empty()) require(frames, "frames");
    for (size_t i = 0; i < s.frames.size(); ++i) frames[i] = from_frame(s.frames[i]);
  });
}

void mimicry_strokes_destroy(mimicry_strokes* strokes) {
  delete strokes;
}
