#include <cassert>

#include <mimicry/base/error.h>
#include <mimicry/session/stroke_session.h>

namespace mimicry::session {

StrokeSession::StrokeSession(const technique::Canvas& canvas,
                             const technique::TechniqueInfo& technique,
                             const SessionOptions& options)
    : canvas_(canvas),
      technique_(&technique),
      options_(options),
      builder_(canvas.target->mesh(), canvas.target->half_edges()) {
  assert(!technique.needs_bake || canvas.projector);
  builder_.reserve(options.expected_frames);
}

void StrokeSession::begin(const Similarity& model_to_world) {
  builder_.clear();
  memory_ = {};
  model_to_world_ = model_to_world;
  canvas_.metres_per_unit = model_to_world.scale;
  counts_ = {};
  answers_ = {};
  frame_ = 0;
  last_time_s_ = -kInfinity;
  drawing_ = true;
}

FrameStatus StrokeSession::add(const stroke::Frame& frame) {
  const FrameStatus status = drawing_ ? judge(frame) : FrameStatus::rejected;
  ++counts_[status];
  ++frame_;
  return status;
}

FrameStatus StrokeSession::judge(const stroke::Frame& frame) {
  if (!stroke::is_usable(frame, last_time_s_)) return FrameStatus::rejected;
  last_time_s_ = frame.time_s;
  const bool first = builder_.curve().points.empty();
  const Vec3& pen = frame.controller.position;
  if (!first && (pen - last_pen_).norm() < options_.minimum_motion_m) return FrameStatus::still;

  const stroke::Frame model = stroke::to_model(frame, model_to_world_);
  const technique::Step step = technique_->step(canvas_, memory_, model, options_.technique);
  memory_ = step.memory;
  ++answers_[step.answer];
  if (step.answer == technique::Answer::miss) {
    if (options_.misses == MissPolicy::split) builder_.break_here();
    return FrameStatus::missed;
  }
  last_pen_ = pen;
  builder_.append({step.surface, step.position, canvas_.target->normal(step.surface), frame_,
                   frame.time_s, (model.controller.position - step.position).norm()});
  return FrameStatus::inked;
}

curve::ProjectedCurve project(const technique::Canvas& canvas,
                              const technique::TechniqueInfo& technique,
                              const stroke::Stroke& stroke, const SessionOptions& options) {
  stroke::require_usable(stroke);
  SessionOptions sized = options;
  sized.expected_frames = stroke.frames.size();
  StrokeSession session(canvas, technique, sized);
  session.begin(stroke.model_to_world);
  for (const stroke::Frame& frame : stroke.frames) session.add(frame);
  session.end();
  return session.curve();
}

}  // namespace mimicry::session
