#include "cli/replay_jobs.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <utility>

#include <mimicry/base/error.h>
#include <mimicry/io/csv.h>
#include <mimicry/io/measure_cells.h>
#include <mimicry/io/strokes.h>
#include <mimicry/study/keypoints.h>
#include <mimicry/study/recording.h>

#include "cli/simulated_drawing.h"

namespace mimicry::cli {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> make_columns() {
  std::vector<std::string> columns = {"participant", "stroke", "method", "shape",    "index",
                                      "curve",       "repeat", "task",   "simulated"};
  const auto add = [&](std::span<const std::string> more) {
    columns.insert(columns.end(), more.begin(), more.end());
  };
  add(io::measure_columns());
  columns.push_back("pieces");
  add(io::more_measure_columns());
  columns.insert(columns.end(), {"frames", "missed", "rejected"});
  return columns;
}

std::int64_t part_count(const curve::ProjectedCurve& curve) {
  if (curve.points.empty()) return 0;
  return 1 + std::count_if(curve.pieces.begin(), curve.pieces.end(),
                           [](const curve::Piece& p) { return p.kind == curve::PieceKind::gap; });
}

}  // namespace

const std::vector<std::string>& replay_columns() {
  static const std::vector<std::string> columns = make_columns();
  return columns;
}

ReplaySource::ReplaySource(const std::vector<std::string>& paths) : paths_(paths) {
  for (const std::string& path : paths_) {
    std::error_code trouble;
    const fs::file_status status = fs::status(path, trouble);
    if (!fs::exists(status)) throw Error(ErrorKind::io, path + ": is not there; check the path");
    // A folder counts by its files, so that progress is even.
    if (fs::is_directory(status)) {
      for (const auto& entry : fs::directory_iterator(path))
        if (entry.is_regular_file()) bytes_ += entry.file_size();
    } else {
      const auto size = fs::file_size(path, trouble);
      if (!trouble) bytes_ += size;  // what a pipe will give is not known
    }
  }
}

std::optional<ReplayJob> ReplaySource::next() {
  for (;;) {
    if (splitter_) {
      if (auto job = next_of_file()) return job;
    } else if (participant_) {
      if (auto job = next_of_folder()) return job;
    }
    splitter_.reset();
    participant_.reset();
    if (path_ == paths_.size()) return std::nullopt;
    const std::string& path = paths_[path_++];
    index_ = 0;
    if (fs::is_directory(path)) {
      try {
        participant_ = std::make_shared<const Participant>(open_participant(path));
      } catch (const Error& error) {
        ReplayJob job;
        job.source = path;
        job.problem = error.what();
        return job;
      }
      continue;
    }
    name_ = fs::path(path).filename().string();
    file_.reset(std::fopen(path.c_str(), "rb"));
    if (!file_) throw Error(ErrorKind::io, path + ": cannot be opened: " + std::strerror(errno));
    splitter_.emplace([this, path](char* buffer, std::size_t size) {
      const std::size_t count = std::fread(buffer, 1, size, file_.get());
      if (count == 0 && std::ferror(file_.get()) != 0)
        throw Error(ErrorKind::io, path + ": cannot be read: " + std::strerror(errno));
      bytes_read_ += count;
      return count;
    });
  }
}

std::optional<ReplayJob> ReplaySource::next_of_file() {
  std::optional<std::string> text = splitter_->next();
  if (!text) return std::nullopt;
  ReplayJob job;
  job.source = name_;
  job.index = index_++;
  job.text = std::move(*text);
  return job;
}

std::optional<ReplayJob> ReplaySource::next_of_folder() {
  const study::StudySequence& sequence = participant_->sequence;
  if (index_ == sequence.methods.size() * sequence.shapes.size()) return std::nullopt;
  ReplayJob job;
  job.source = participant_->name;
  job.participant = participant_;
  job.method = sequence.methods[index_ / sequence.shapes.size()];
  job.shape = sequence.shapes[index_ % sequence.shapes.size()];
  ++index_;
  std::error_code none;
  const auto size =
      fs::file_size(fs::path(participant_->folder) / recording_name(job.method, job.shape), none);
  if (!none) bytes_read_ += size;
  return job;
}

struct Replayer::Shape {
  std::string problem;
  std::optional<spatial::Target> target;
  std::unique_ptr<PreparedCanvas> canvas;
  const StudyShape* study = nullptr;
  std::vector<study::IntendedCurve> curves;  // of the study's shape
};

// What says which stroke a row is of.
struct Replayer::Row {
  std::string participant, stroke, shape, curve, task;
  std::optional<std::size_t> index;
  bool repeat = false;
  io::Cell simulated;

  std::vector<io::Cell> cells(const std::string& method) const {
    const auto text = [](const std::string& s) -> io::Cell {
      if (s.empty()) return std::monostate();
      return s;
    };
    io::Cell number;
    if (index) number = static_cast<std::int64_t>(*index);
    return {text(participant), text(stroke),         method,     text(shape), number,
            text(curve),       std::int64_t{repeat}, text(task), simulated};
  }
};

Replayer::Replayer(const ReplayOptions& options) : options_(options) {
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
    const NamedMesh named =
        load_mesh(options_.mesh.empty() ? mesh_spec(options_.shapes, name) : options_.mesh);
    shape.target.emplace(make_target(named));
    if (study_) shape.study = study_->find(fs::path(name).stem().string());
    if (shape.study != nullptr) {
      study::require_fits(*shape.study->shape, named.mesh);
      for (study::TargetCurve curve : shape.study->shape->curves) {
        if (curve.keypoints.empty())
          curve.keypoints = study::keypoints(shape.target->mesh(), shape.target->half_edges(),
                                             curve.points, shape.study->shape->scale);
        shape.curves.push_back(
            study::intended_curve(shape.target->mesh(), curve, shape.study->shape->scale));
      }
    }
    shape.canvas = std::make_unique<PreparedCanvas>(*shape.target, options_.techniques);
  } catch (const Error& error) {
    if (error.kind() == ErrorKind::cancelled) throw;
    shape.problem = error.what();
  }
  return *loaded_.emplace(name, std::move(made)).first->second;
}

void Replayer::reject(const Row& row, const std::string& reason, ReplayRows& rows) const {
  const auto& columns = replay_columns();
  for (const technique::TechniqueInfo* info : options_.techniques) {
    std::vector<io::Cell> cells = row.cells(std::string(info->name));
    cells.resize(columns.size() - 1);
    cells.emplace_back(reason);
    rows.csv += io::csv_line(cells);
    rows.json_lines += io::json_line(columns, cells);
    ++rows.rows;
    ++rows.rejected;
  }
  rows.reasons.push_back(reason);
}

void Replayer::replay_stroke(const stroke::Stroke& stroke, const Shape& shape,
                             const study::IntendedCurve& intended, const Row& row,
                             ReplayRows& rows) const {
  const auto& columns = replay_columns();
  const std::vector<study::MotionSample> motion = study::motion_of(stroke);
  for (const technique::TechniqueInfo* info : options_.techniques) {
    std::vector<io::Cell> cells = row.cells(std::string(info->name));
    std::string reason;
    try {
      session::SessionOptions options;
      options.misses = options_.misses;
      options.expected_frames = stroke.frames.size();
      session::StrokeSession session(shape.canvas->canvas(), *info, options);
      session.begin(stroke.model_to_world);
      for (const stroke::Frame& frame : stroke.frames) session.add(frame);
      session.end();
      const auto add = [&](const std::vector<io::Cell>& more) {
        cells.insert(cells.end(), more.begin(), more.end());
      };
      const study::Measures measures = study::measure(
          shape.target->mesh(), shape.target->half_edges(), intended, session.curve(), motion);
      add(io::measure_cells(measures));
      cells.emplace_back(part_count(session.curve()));
      add(io::more_measure_cells(measures));
      cells.emplace_back(static_cast<std::int64_t>(stroke.frames.size()));
      cells.emplace_back(std::int64_t{session.counts()[session::FrameStatus::missed]});
      cells.emplace_back();
    } catch (const Error& error) {
      reason = row.participant + ": " + row.stroke + ": " + std::string(info->name) + ": " +
               error.what();
      cells.resize(columns.size() - 1);
      cells.emplace_back(reason);
      ++rows.rejected;
      rows.reasons.push_back(reason);
    }
    rows.csv += io::csv_line(cells);
    rows.json_lines += io::json_line(columns, cells);
    ++rows.rows;
  }
}

void Replayer::replay_text(const ReplayJob& job, ReplayRows& rows) const {
  Row row;
  row.participant = job.source;
  row.stroke = std::to_string(job.index);
  row.index = job.index;
  try {
    io::read_strokes(
        job.text, job.source,
        [&](stroke::Stroke&& stroke) {
          if (!stroke.id.empty()) row.stroke = stroke.id;
          row.shape = stroke.target;
          row.simulated = simulation_cell(stroke.simulated);
          const auto refuse = [&](const std::string& why) {
            throw Error(ErrorKind::invalid_input,
                        job.source + ": stroke " + std::to_string(job.index) + ": " + why);
          };
          if (stroke.intended) row.curve = stroke.intended->name;
          const Shape& on = shape(stroke.target);
          if (!on.problem.empty()) refuse(on.problem);
          if (stroke.frames.empty()) refuse("the stroke is empty: it has no frames");
          if (!stroke.intended || stroke.intended->points.empty())
            refuse("has no intended curve to measure against");
          study::TargetCurve curve;
          curve.points = stroke.intended->points;
          study::IntendedCurve intended;
          try {
            intended = study::intended_curve(on.target->mesh(), curve, stroke.model_to_world.scale);
            curve.keypoints = study::keypoints(on.target->mesh(), on.target->half_edges(),
                                               curve.points, stroke.model_to_world.scale);
            intended = study::intended_curve(on.target->mesh(), curve, stroke.model_to_world.scale);
          } catch (const Error& error) {
            refuse(error.what());
          }
          replay_stroke(stroke, on, intended, row, rows);
        },
        job.index);
  } catch (const Error& error) {
    if (error.kind() == ErrorKind::cancelled) throw;
    reject(row, error.what(), rows);
  }
}

void Replayer::replay_recording(const ReplayJob& job, ReplayRows& rows) const {
  const std::string file = recording_name(job.method, job.shape);
  const auto trials = job.participant->sequence.trials(job.method, job.shape);
  Row row;
  row.participant = job.source;
  const auto shape_at = static_cast<std::size_t>(job.shape);
  if (study_) row.shape = study_->name(job.shape);
  if (row.shape.empty() && shape_at < study::kStudyShapes.size())
    row.shape = study::kStudyShapes[shape_at];
  const auto name_stroke = [&](std::size_t i) {
    row.stroke = file + "#" + std::to_string(i);
    row.index = i;
    row.curve = i < trials.size() ? std::to_string(trials[i].curve) : "";
    row.task = i < trials.size() ? std::string(study::task_name(trials[i].task)) : "";
    row.repeat = i < trials.size() && trials[i].repeat;
  };
  const auto reject_all = [&](const std::string& reason) {
    for (std::size_t i = 0; i < std::max<std::size_t>(1, trials.size()); ++i) {
      name_stroke(i);
      reject(row, reason, rows);
    }
    rows.reasons.resize(1);
  };
  if (row.shape.empty())
    return reject_all(job.source + ": shape " + std::to_string(job.shape) + " is not known");
  const Shape& on = shape(row.shape);
  if (!on.problem.empty()) return reject_all(job.source + "/" + file + ": " + on.problem);
  if (on.study == nullptr)
    return reject_all(job.source + "/" + file + ": there are no target curves of the shape " +
                      row.shape + "; give --targets");
  std::vector<study::RecordedStroke> strokes;
  try {
    strokes = load_recording(*job.participant, job.method, job.shape);
  } catch (const Error& error) {
    return reject_all(error.what());
  }
  for (std::size_t i = 0; i < std::max(strokes.size(), trials.size()); ++i) {
    name_stroke(i);
    row.simulated = simulation_cell(i < strokes.size() ? strokes[i].simulated : std::nullopt);
    try {
      const auto refuse = [](const std::string& why) {
        throw Error(ErrorKind::invalid_input, why);
      };
      if (i >= strokes.size())
        refuse("the file has " + std::to_string(strokes.size()) + " strokes");
      if (i >= trials.size())
        refuse("the sequence asks for " + std::to_string(trials.size()) + " strokes only");
      const auto curve = static_cast<std::size_t>(trials[i].curve);
      if (curve >= on.curves.size())
        refuse("the shape has no target curve " + std::to_string(trials[i].curve));
      // Refuses what was drawn on another mesh.
      study::curve_of(strokes[i], *on.target);
      const stroke::Stroke stroke = study::stroke_of(strokes[i]);
      if (stroke.model_to_world.scale == on.study->shape->scale) {
        replay_stroke(stroke, on, on.curves[curve], row, rows);
      } else {
        study::TargetCurve scaled = on.study->shape->curves[curve];
        if (scaled.keypoints.empty())
          scaled.keypoints = study::keypoints(on.target->mesh(), on.target->half_edges(),
                                              scaled.points, stroke.model_to_world.scale);
        replay_stroke(stroke, on,
                      study::intended_curve(on.target->mesh(), scaled, stroke.model_to_world.scale),
                      row, rows);
      }
    } catch (const Error& error) {
      reject(row, job.source + "/" + row.stroke + ": " + error.what(), rows);
    }
  }
}

ReplayRows Replayer::run(const ReplayJob& job) const {
  ReplayRows rows;
  if (!job.problem.empty()) {
    Row row;
    row.participant = job.source;
    reject(row, job.problem, rows);
  } else if (job.participant) {
    replay_recording(job, rows);
  } else {
    replay_text(job, rows);
  }
  return rows;
}

}  // namespace mimicry::cli
