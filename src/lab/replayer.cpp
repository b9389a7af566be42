#include "lab/replayer.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include <mimicry/assets/canvas.h>
#include <mimicry/base/error.h>
#include <mimicry/io/strokes.h>
#include <mimicry/study/recording.h>
#include <mimicry/study/targets.h>

#include "assets/meshes.h"
#include "files/names.h"
#include "lab/study_numbers.h"

namespace mimicry::lab {
namespace {

std::size_t part_count(const ProjectedCurve& curve) {
  if (curve.points.empty()) return 0;
  const auto gaps = std::count_if(curve.pieces.begin(), curve.pieces.end(),
                                  [](const Piece& p) { return p.kind == PieceKind::gap; });
  return 1 + static_cast<std::size_t>(gaps);
}

[[noreturn]] void refuse(const std::string& why) {
  throw Error(ErrorKind::invalid_input, why);
}

void name_method(MeasuredRow& row, const TechniqueInfo& info) {
  row.method = std::string(info.name);
  row.method_number = number_of_method(info.name);
}

void add(const MeasuredRow& row, ReplayRows& rows) {
  rows.csv += csv_row(row);
  rows.json_lines += json_row(row);
  ++rows.rows;
}

}  // namespace

struct Replayer::Shape {
  std::string problem;
  std::optional<Target> target;
  Canvas canvas;
  const StudyShape* study = nullptr;
  std::vector<IntendedCurve> curves;  // of the study's shape
};

Replayer::Replayer(const ReplayOptions& options, const Monitor& monitor)
    : options_(options), monitor_(monitor) {
  if (!options.targets.empty())
    study_.emplace(StudyShapeOptions{options.shapes, options.targets, {}});
}

Replayer::~Replayer() = default;

const Replayer::Shape& Replayer::shape(const std::string& name) const {
  const std::lock_guard guard(lock_);
  const auto known = loaded_.find(name);
  if (known != loaded_.end()) return *known->second;
  auto made = std::make_unique<Shape>();
  Shape& shape = *made;
  try {
    const NamedMesh named = load_mesh(
        options_.mesh.empty() ? mesh_spec(options_.shapes, name) : options_.mesh, monitor_);
    shape.target.emplace(make_target(named, {}, monitor_));
    if (study_) shape.study = study_->find(file_stem(name));
    if (shape.study != nullptr) {
      const TargetShape& published = *shape.study->shape;
      require_fits(published, named.mesh);
      for (const TargetCurve& curve : published.curves)
        shape.curves.push_back(intended_curve(shape.target->mesh(),
                                              with_keypoints(curve, *shape.target, published.scale),
                                              published.scale));
    }
    shape.canvas = make_canvas(*shape.target, options_.techniques, monitor_, {},
                               {.options = {}, .threads = options_.threads});
  } catch (const Error& error) {
    if (error.kind() == ErrorKind::cancelled) throw;
    shape.problem = error.what();
  }
  return *loaded_.emplace(name, std::move(made)).first->second;
}

void Replayer::reject(MeasuredRow row, const std::string& reason, ReplayRows& rows) const {
  row.rejected = reason;
  for (const TechniqueInfo* info : options_.techniques) {
    name_method(row, *info);
    add(row, rows);
    ++rows.rejected;
  }
  rows.reasons.push_back(reason);
}

void Replayer::replay_stroke(const Stroke& stroke, const Shape& shape,
                             const IntendedCurve& intended, const MeasuredRow& unmeasured,
                             ReplayRows& rows) const {
  const std::vector<MotionSample> motion = motion_of(stroke);
  for (const TechniqueInfo* info : options_.techniques) {
    MeasuredRow row = unmeasured;
    name_method(row, *info);
    try {
      const ProjectedStroke drawn =
          project(shape.canvas, *info, stroke, {.misses = options_.misses});
      row.measures = measure(shape.target->surface(), intended, drawn.curve, motion);
      row.pieces = part_count(drawn.curve);
      row.frames = stroke.frames.size();
      row.missed = static_cast<std::size_t>(drawn.counts[FrameStatus::missed]);
    } catch (const Error& error) {
      row.rejected = row.participant + ": " + row.stroke + ": " + row.method + ": " + error.what();
      ++rows.rejected;
      rows.reasons.push_back(row.rejected);
    }
    add(row, rows);
  }
}

void Replayer::replay_text(const ReplayJob& job, ReplayRows& rows) const {
  MeasuredRow row;
  row.participant = job.source;
  row.stroke = std::to_string(job.index);
  row.index = job.index;
  const std::string place = job.source + ": stroke " + std::to_string(job.index) + ": ";
  try {
    read_strokes(
        job.text, job.source,
        [&](Stroke&& stroke) {
          if (!stroke.id.empty()) row.stroke = stroke.id;
          row.shape = stroke.target;
          row.shape_number = number_of_shape(stroke.target);
          row.simulated = stroke.simulated;
          if (stroke.intended) row.curve = stroke.intended->name;
          const Shape& on = shape(stroke.target);
          if (!on.problem.empty()) refuse(place + on.problem);
          if (stroke.frames.empty()) refuse(place + "the stroke is empty: it has no frames");
          if (!stroke.intended || stroke.intended->points.empty())
            refuse(place + "has no intended curve to measure against");
          const double scale = stroke.model_to_world.scale;
          TargetCurve curve;
          curve.points = stroke.intended->points;
          IntendedCurve intended;
          try {
            // Checks the points, which looking for keypoints does not.
            intended = intended_curve(on.target->mesh(), curve, scale);
            curve = with_keypoints(std::move(curve), *on.target, scale);
            intended = intended_curve(on.target->mesh(), curve, scale);
          } catch (const Error& error) {
            refuse(place + error.what());
          }
          replay_stroke(stroke, on, intended, row, rows);
        },
        job.index);
  } catch (const Error& error) {
    if (error.kind() == ErrorKind::cancelled) throw;
    reject(row, error.what(), rows);
  }
}

void Replayer::replay_recorded(const RecordedStroke& recorded, const Trial& trial,
                               const Shape& shape, const MeasuredRow& row, ReplayRows& rows) const {
  const auto number = static_cast<std::size_t>(trial.curve);
  if (number >= shape.curves.size())
    refuse("the shape has no target curve " + std::to_string(trial.curve));
  // Refuses what was drawn on another mesh.
  curve_of(recorded, *shape.target);
  const Stroke stroke = stroke_of(recorded);
  const TargetShape& published = *shape.study->shape;
  const double scale = stroke.model_to_world.scale;
  if (scale == published.scale)
    return replay_stroke(stroke, shape, shape.curves[number], row, rows);
  const TargetCurve scaled = with_keypoints(published.curves[number], *shape.target, scale);
  replay_stroke(stroke, shape, intended_curve(shape.target->mesh(), scaled, scale), row, rows);
}

void Replayer::replay_recording(const ReplayJob& job, ReplayRows& rows) const {
  const Index shape_number = job.recording.shape;
  const std::string title = job.participant->title(job.recording);
  const auto trials = job.participant->sequence().trials(job.recording.method, shape_number);
  MeasuredRow row;
  row.participant = job.source;
  row.recording = job.recording.file();
  row.shape_number = shape_number;
  row.shape = study_ ? study_->name(shape_number) : std::string(shape_of_number(shape_number));
  const auto name_stroke = [&](std::size_t i) {
    row.stroke = RecordedStrokeName{job.recording, i}.text();
    row.index = i;
    row.curve = i < trials.size() ? std::to_string(trials[i].curve) : "";
    row.task = i < trials.size() ? std::string(task_name(trials[i].task)) : "";
    row.repetition = i < trials.size() && trials[i].repeat;
  };
  const auto reject_all = [&](const std::string& reason) {
    for (std::size_t i = 0; i < std::max<std::size_t>(1, trials.size()); ++i) {
      name_stroke(i);
      reject(row, reason, rows);
    }
    rows.reasons.resize(1);
  };
  if (row.shape.empty())
    return reject_all(job.source + ": shape " + std::to_string(shape_number) + " is not known");
  const Shape& on = shape(row.shape);
  if (!on.problem.empty()) return reject_all(title + ": " + on.problem);
  if (on.study == nullptr)
    return reject_all(title + ": there are no target curves of the shape " + row.shape +
                      "; give --targets");
  std::vector<RecordedStroke> strokes;
  try {
    strokes = job.participant->read(job.recording);
  } catch (const Error& error) {
    return reject_all(error.what());
  }
  for (std::size_t i = 0; i < std::max(strokes.size(), trials.size()); ++i) {
    name_stroke(i);
    row.simulated = i < strokes.size() ? strokes[i].simulated : std::nullopt;
    try {
      if (i >= strokes.size())
        refuse("the file has " + std::to_string(strokes.size()) + " strokes");
      if (i >= trials.size())
        refuse("the sequence asks for " + std::to_string(trials.size()) + " strokes only");
      replay_recorded(strokes[i], trials[i], on, row, rows);
    } catch (const Error& error) {
      reject(row, job.source + "/" + row.stroke + ": " + error.what(), rows);
    }
  }
}

ReplayRows Replayer::run(const ReplayJob& job) const {
  ReplayRows rows;
  if (!job.problem.empty()) {
    MeasuredRow row;
    row.participant = job.source;
    reject(row, job.problem, rows);
  } else if (job.participant) {
    replay_recording(job, rows);
  } else {
    replay_text(job, rows);
  }
  return rows;
}

}  // namespace mimicry::lab
