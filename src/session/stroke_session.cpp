#include <string>

#include <mimicry/base/error.h>
#include <mimicry/session/stroke_session.h>

#include "curve/curve_builder.h"
#include "geodesic/site.h"

namespace mimicry {
namespace {

const Canvas& sound(const Canvas& canvas, const TechniqueInfo& technique) {
  if (!canvas.target) throw Error(ErrorKind::invalid_input, "session: the canvas has no target");
  if (technique.needs_bake && !canvas.projector)
    throw Error(ErrorKind::invalid_input,
                "technique '" + technique.name +
                    "' needs the target's bake; bake it, or make the canvas with load_canvas");
  return canvas;
}

}  // namespace

StrokeSession::StrokeSession(const Canvas& canvas, const TechniqueInfo& technique,
                             const SessionOptions& options)
    : canvas_(sound(canvas, technique)),
      technique_(&technique),
      options_(options),
      own_options_(options.technique.block(technique)),
      memory_(technique.first_memory),
      builder_(std::make_unique<CurveBuilder>(canvas.target.surface())) {
  builder_->reserve(options.expected_frames);
}

StrokeSession::~StrokeSession() = default;
StrokeSession::StrokeSession(StrokeSession&&) noexcept = default;
StrokeSession& StrokeSession::operator=(StrokeSession&&) noexcept = default;

const ProjectedCurve& StrokeSession::curve() const {
  return builder_->curve();
}

void StrokeSession::begin(const Similarity& model_to_world) {
  builder_->clear();
  memory_ = technique_->first_memory;
  model_to_world_ = model_to_world;
  canvas_.metres_per_unit = model_to_world.scale;
  counts_ = {};
  answers_ = {};
  frame_ = 0;
  last_time_s_ = -kInfinity;
  drawing_ = true;
}

FrameStatus StrokeSession::add(const Frame& frame) {
  const FrameStatus status = drawing_ ? judge(frame) : FrameStatus::rejected;
  ++counts_[status];
  ++frame_;
  return status;
}

std::optional<Vec3> StrokeSession::ink(const Frame& frame) {
  if (add(frame) != FrameStatus::inked) return std::nullopt;
  return model_to_world_.point(builder_->curve().points.back().position);
}

// A technique of the user's own may answer with what is no answer, or no point of the mesh.
bool StrokeSession::is_point(const TechniqueStep& step) const {
  return static_cast<std::size_t>(step.answer) < kAnswerCount && step.answer != Answer::miss &&
         is_on(canvas_.target.mesh(), step.surface) && step.position.allFinite();
}

FrameStatus StrokeSession::judge(const Frame& frame) {
  if (!is_usable(frame, last_time_s_)) return FrameStatus::rejected;
  last_time_s_ = frame.time_s;
  const bool first = builder_->curve().points.empty();
  const Vec3& pen = frame.controller.position;
  if (!first && (pen - last_pen_).norm() < options_.minimum_motion_m) return FrameStatus::still;

  const Frame model = to_model(frame, model_to_world_);
  const TechniqueStep step = technique_->step(canvas_, model, own_options_.data(), memory_.data());
  const Answer answer = is_point(step) ? step.answer : Answer::miss;
  ++answers_[answer];
  if (answer == Answer::miss) {
    if (options_.misses == MissPolicy::split) builder_->break_here();
    return FrameStatus::missed;
  }
  last_pen_ = pen;
  builder_->append({step.surface, step.position, canvas_.target.normal(step.surface), frame_,
                    frame.time_s, (model.controller.position - step.position).norm()});
  return FrameStatus::inked;
}

ProjectedStroke project(const Canvas& canvas, const TechniqueInfo& technique, const Stroke& stroke,
                        const SessionOptions& options) {
  require_usable(stroke);
  SessionOptions sized = options;
  sized.expected_frames = stroke.frames.size();
  StrokeSession session(canvas, technique, sized);
  session.begin(stroke.model_to_world);
  ProjectedStroke result;
  result.statuses.reserve(stroke.frames.size());
  for (const Frame& frame : stroke.frames) result.statuses.push_back(session.add(frame));
  session.end();
  result.curve = session.curve();
  result.counts = session.counts();
  result.answers = session.answers();
  return result;
}

}  // namespace mimicry
