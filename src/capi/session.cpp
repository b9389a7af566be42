#include <cmath>

#include "capi/handles.h"

using namespace mimicry;
using namespace mimicry::capi;

namespace {

// Ink vertices that a frame has room for before memory is asked for.
constexpr std::size_t kInkPerFrame = 4;

void renew(mimicry_session& s) {
  const Canvas canvas = canvas_of(s.canvas);
  s.session = std::make_unique<StrokeSession>(canvas, *s.technique, s.options);
  s.options_changed = false;
}

void begin(mimicry_session& s, const mimicry_similarity* model_to_world) {
  s.model_to_world = to_similarity(model_to_world);
  if (s.options_changed) renew(s);
  s.session->begin(s.model_to_world);
  s.ink.clear();
}

FrameStatus add(mimicry_session& s, const Frame& frame) {
  const FrameStatus status = s.session->add(frame);
  const ProjectedCurve& curve = s.session->curve();
  if (status == FrameStatus::inked)
    append_ink(s.ink, curve, curve.points.size() - 1, *s.canvas.target);
  return status;
}

mimicry_curve curve_of(const mimicry_session& s) {
  CurveRecord record;
  record.technique = std::string(s.technique->name);
  for (const OptionInfo& o : s.technique->options) {
    if (!is_listed(*s.technique, o, s.options.technique)) continue;
    const auto values = option_value(*s.technique, o, s.options.technique);
    record.options[o.name] = {values.begin(), values.end()};
  }
  record.model_to_world = s.model_to_world;
  record.curve = s.session->curve();
  return {s.canvas.target, std::move(record), s.ink};
}

}  // namespace

const TechniqueInfo& mimicry::capi::usable_technique(const mimicry_target& target,
                                                     const char* name) {
  const TechniqueInfo& row = find_technique(text(name, "technique"));
  if (row.needs_bake && !target.projector)
    throw Error(ErrorKind::invalid_input,
                row.name +
                    " needs the target's bake; bake it (mimicry_bake) or load its .mimicry file "
                    "(mimicry_target_with_embedding)");
  return row;
}

mimicry_status mimicry_session_create(const mimicry_target* target, const char* technique,
                                      mimicry_session** out) {
  return made(out, [&] {
    require(target, "target");
    mimicry_session s{};
    s.canvas = *target;
    s.technique = &usable_technique(*target, technique);
    s.ink.reserve(kInkPerFrame * s.options.expected_frames);
    renew(s);
    return s;
  });
}

void mimicry_session_destroy(mimicry_session* session) {
  delete session;
}

mimicry_status mimicry_session_set_option(mimicry_session* session, const char* name,
                                          const double* values, size_t count) {
  return guarded([&] {
    require(session, "session");
    require(values, "values");
    set_option(*session->technique, session->options.technique, text(name, "name"),
               {values, count});
    session->options_changed = true;
  });
}

mimicry_status mimicry_session_set_minimum_motion(mimicry_session* session, double metres) {
  return guarded([&] {
    require(session, "session");
    if (!std::isfinite(metres) || metres < 0.0)
      throw Error(ErrorKind::invalid_input,
                  "the minimum motion is " + std::to_string(metres) + " m; give 0 or more");
    session->options.minimum_motion_m = metres;
    session->options_changed = true;
  });
}

mimicry_status mimicry_session_set_split_at_misses(mimicry_session* session, int32_t split) {
  return guarded([&] {
    require(session, "session");
    session->options.misses = split ? MissPolicy::split : MissPolicy::connect;
    session->options_changed = true;
  });
}

mimicry_status mimicry_session_begin(mimicry_session* session,
                                     const mimicry_similarity* model_to_world) {
  return guarded([&] {
    require(session, "session");
    begin(*session, model_to_world);
  });
}

mimicry_status mimicry_session_add(mimicry_session* session, const mimicry_frame* frame,
                                   mimicry_frame_status* frame_status) {
  return guarded([&] {
    require(session, "session");
    require(frame, "frame");
    const auto status = add(*session, to_frame(*frame));
    if (frame_status) *frame_status = static_cast<mimicry_frame_status>(status);
  });
}

mimicry_status mimicry_session_end(mimicry_session* session) {
  return guarded([&] {
    require(session, "session");
    session->session->end();
  });
}

const mimicry_ink* mimicry_session_ink(const mimicry_session* session) {
  return session ? session->ink.data() : nullptr;
}
size_t mimicry_session_ink_count(const mimicry_session* session) {
  return session ? session->ink.size() : 0;
}

mimicry_status mimicry_session_curve(const mimicry_session* session, mimicry_curve** out) {
  return made(out, [&] {
    require(session, "session");
    return curve_of(*session);
  });
}

mimicry_status mimicry_session_project(mimicry_session* session,
                                       const mimicry_similarity* model_to_world,
                                       const mimicry_frame* frames, size_t count,
                                       mimicry_curve** out) {
  return made(out, [&] {
    require(session, "session");
    const Stroke stroke = to_stroke(model_to_world, frames, count);
    begin(*session, model_to_world);
    for (const Frame& frame : stroke.frames) add(*session, frame);
    session->session->end();
    return curve_of(*session);
  });
}
