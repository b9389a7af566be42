#include "lab/recorded_study.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <mutex>
#include <optional>

#include <mimicry/assets/canvas.h>
#include <mimicry/assets/files.h>
#include <mimicry/base/error.h>
#include <mimicry/base/parallel.h>

#include "assets/meshes.h"
#include "assets/work.h"
#include "lab/participant_folder.h"
#include "lab/study_numbers.h"
#include "lab/study_shapes.h"

namespace mimicry::lab {
namespace {

// A shape of the study, or why there is none.
struct MeasuredShape {
  std::string name;
  std::string problem;
  std::optional<Target> target;
  TargetShape curves;  // every curve with keypoints
};

struct Job {
  const ParticipantFolder* participant;
  RecordingName recording;
};

struct Outcome {
  std::vector<MeasuredRow> rows;
  std::size_t failed_filters = 0;
  std::vector<RejectedStroke> rejected;
  std::vector<std::string> notes;
};

void load_shape(MeasuredShape& shape, const RecordedStudyOptions& options, const StudyShapes& study,
                const Monitor& monitor) {
  try {
    const NamedMesh named = load_mesh(mesh_spec(options.shapes, shape.name), monitor);
    shape.target.emplace(make_target(named, {}, monitor));
    const StudyShape* known = study.find(shape.name);
    if (known == nullptr)
      throw Error(ErrorKind::invalid_input,
                  source_name(options.targets) + ": has no shape '" + shape.name + "'");
    require_fits(*known->shape, named.mesh);
    shape.curves = *known->shape;
    for (TargetCurve& curve : shape.curves.curves)
      curve = with_keypoints(std::move(curve), *shape.target, shape.curves.scale);
  } catch (const Error& error) {
    if (error.kind() == ErrorKind::cancelled) throw;
    shape.problem = error.what();
  }
}

std::map<Index, MeasuredShape> load_shapes(const std::vector<ParticipantFolder>& participants,
                                           const RecordedStudyOptions& options,
                                           const Monitor& monitor) {
  const StudyShapes study({options.shapes, options.targets, {}});
  std::map<Index, MeasuredShape> shapes;
  for (const ParticipantFolder& participant : participants)
    for (const Index number : participant.sequence().shapes) {
      if (shapes.contains(number)) continue;
      MeasuredShape& shape = shapes[number];
      shape.name = study.name(number);
      if (shape.name.empty())
        shape.problem = "neither the study nor " + source_name(options.targets) + " has a shape " +
                        std::to_string(number);
      else
        load_shape(shape, options, study, monitor);
    }
  return shapes;
}

// Of a method that has no number of the study the recordings say the technique's name.
void name_method(Index number, const std::string& word, std::string& method) {
  method =
      method_word(number).empty() && !word.empty() ? word : name_of_method(std::to_string(number));
}

class Recording {
 public:
  Recording(const Job& job, const MeasuredShape& shape, const RecordedStudyOptions& options)
      : folder_(*job.participant), name_(job.recording), shape_(shape), options_(options) {}

  Outcome run() {
    if (!shape_.problem.empty()) {
      reject(name_.method, "", "", shape_.problem);
      return std::move(outcome_);
    }
    std::vector<RecordedStroke> strokes;
    try {
      strokes = folder_.read(name_);
    } catch (const Error& error) {
      reject(name_.method, "", "", error.what());
      return std::move(outcome_);
    }
    const std::size_t expected = folder_.sequence().trials(name_.method, name_.shape).size();
    for (std::size_t i = 0; i < std::max(strokes.size(), expected); ++i) {
      // Known once the stroke has said it.
      Index method = name_.method;
      std::string word;
      try {
        if (i >= strokes.size())
          throw Error(ErrorKind::invalid_input,
                      "is missing: the file has " + std::to_string(strokes.size()) +
                          " strokes, the sequence asks for " + std::to_string(expected));
        measure_stroke(strokes[i], i, method, word);
      } catch (const Error& error) {
        reject(method, word, std::to_string(i), error.what());
      }
    }
    return std::move(outcome_);
  }

 private:
  // Of a row, measured or rejected: whose stroke it is.
  template <class Row>
  void say_where(Row& row, Index method, const std::string& word) const {
    row.participant = folder_.name();
    row.recording = name_.file();
    name_method(method, word, row.method);
    row.method_number = method;
    row.shape = shape_.name;
    row.shape_number = name_.shape;
  }

  void reject(Index method, const std::string& word, const std::string& index,
              const std::string& reason) {
    RejectedStroke& rejected = outcome_.rejected.emplace_back();
    say_where(rejected, method, word);
    rejected.index = index;
    rejected.reason = reason;
  }

  // What the stroke was asked to be.
  Trial trial_of(std::size_t index, Index method) const {
    const StudySequence& sequence = folder_.sequence();
    std::vector<Trial> trials = sequence.trials(method, name_.shape);
    if (trials.empty()) trials = sequence.trials(name_.method, name_.shape);
    if (index >= trials.size())
      throw Error(ErrorKind::invalid_input,
                  "the sequence asks for " + std::to_string(trials.size()) + " strokes only");
    const Trial& trial = trials[index];
    if (static_cast<std::size_t>(trial.curve) >= shape_.curves.curves.size())
      throw Error(ErrorKind::invalid_input,
                  "the sequence asks for curve " + std::to_string(trial.curve) + " of " +
                      shape_.name + ", which has " + std::to_string(shape_.curves.curves.size()) +
                      " target curves");
    return trial;
  }

  void measure_stroke(const RecordedStroke& stroke, std::size_t index, Index& method,
                      std::string& word) {
    word = method_of(stroke);
    const Index said = method_number(word);
    if (said != kNone && said != method) {
      if (outcome_.notes.empty())
        outcome_.notes.push_back(folder_.title(name_) + ": holds strokes of M '" + word +
                                 "', method " + std::to_string(said) +
                                 "; they are measured as what M says");
      method = said;
    }
    const Trial trial = trial_of(index, method);
    const std::vector<MotionSample> motion = motion_of(stroke);
    const ProjectedCurve curve = curve_of(stroke, *shape_.target);
    const TriangleMesh& mesh = shape_.target->mesh();
    const IntendedCurve intended =
        intended_curve(mesh, shape_.curves.curves[static_cast<std::size_t>(trial.curve)],
                       placement_of(stroke).scale);
    MeasuredRow row;
    row.measures =
        measure(shape_.target->surface(), intended, curve, motion, {options_.join_pieces});
    say_where(row, method, word);
    row.index = index;
    row.curve = std::to_string(trial.curve);
    row.repetition = trial.repeat;
    row.task = std::string(task_name(trial.task));
    row.simulated = stroke.simulated;
    row.pieces = piece_count(stroke);
    row.frames = frame_count(stroke);
    outcome_.failed_filters += row.measures->filters.passed() ? 0 : 1;
    outcome_.rows.push_back(std::move(row));
  }

  const ParticipantFolder& folder_;
  const RecordingName name_;
  const MeasuredShape& shape_;
  const RecordedStudyOptions& options_;
  Outcome outcome_;
};

}  // namespace

RecordedStudy measure_recordings(const RecordedStudyOptions& options, const Monitor& monitor) {
  RecordedStudy study;
  std::vector<ParticipantFolder> participants;
  for (const std::string& folder : options.participants) try {
      participants.emplace_back(folder);
    } catch (const Error& error) {
      RejectedStroke& rejected = study.rejected.emplace_back();
      rejected.participant = folder;
      rejected.reason = error.what();
    }
  const std::map<Index, MeasuredShape> shapes = load_shapes(participants, options, monitor);
  std::vector<Job> jobs;
  for (const ParticipantFolder& participant : participants)
    for (const Index method : participant.sequence().methods)
      for (const Index shape : participant.sequence().shapes)
        jobs.push_back({&participant, {method, shape}});

  std::vector<Outcome> outcomes(jobs.size());
  std::mutex lock;
  std::size_t done = 0;
  parallel_for(jobs.size(), thread_count(options.threads), [&](std::size_t i) {
    outcomes[i] = Recording(jobs[i], shapes.at(jobs[i].recording.shape), options).run();
    const std::lock_guard guard(lock);
    monitor.report("measuring", ++done, jobs.size());
  });
  for (Outcome& outcome : outcomes) {
    std::move(outcome.rows.begin(), outcome.rows.end(), std::back_inserter(study.rows));
    std::move(outcome.rejected.begin(), outcome.rejected.end(), std::back_inserter(study.rejected));
    study.failed_filters += outcome.failed_filters;
    for (const std::string& note : outcome.notes) monitor.tell(note);
  }
  return study;
}

}  // namespace mimicry::lab
