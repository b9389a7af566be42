#include <algorithm>
#include <atomic>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include <mimicry/base/error.h>
#include <mimicry/base/parallel.h>
#include <mimicry/files/file.h>
#include <mimicry/files/output_lock.h>
#include <mimicry/io/measure_cells.h>
#include <mimicry/study/keypoints.h>

#include "cli/commands.h"
#include "cli/console.h"
#include "cli/embedding_input.h"
#include "cli/mesh_input.h"
#include "cli/participant.h"
#include "cli/simulated_drawing.h"
#include "cli/target_curves.h"

namespace mimicry::cli {
namespace {

struct MeasureArguments {
  std::vector<std::string> folders;
  std::string shapes;
  std::string targets;
  std::string out;
  bool all = false;
  bool per_piece = false;
  int threads = 0;
};

// A shape of the study, or why there is none.
struct MeasuredShape {
  std::string name;
  std::string problem;
  std::optional<spatial::Target> target;
  study::TargetShape curves;  // every curve with keypoints
};

struct Job {
  const Participant* participant;
  Index method;  // the file's number
  Index shape;
};

struct Rejected {
  std::string participant;
  Index method;
  Index shape;
  std::optional<std::size_t> index;  // none: the whole file
  std::string reason;
};

struct Outcome {
  std::vector<std::vector<io::Cell>> rows;  // `simulated` last
  std::size_t failed_filters = 0;
  std::vector<Rejected> rejected;
  std::vector<std::string> notes;
};

void load_shape(MeasuredShape& shape, const std::string& folder, const study::TargetSet& set,
                const std::string& file) {
  try {
    const NamedMesh named = load_mesh(find_mesh_file(folder, shape.name));
    shape.target.emplace(make_target(named));
    shape.curves = find_target_shape(set, shape.name, file);
    study::require_fits(shape.curves, named.mesh);
    for (study::TargetCurve& curve : shape.curves.curves)
      if (curve.keypoints.empty())
        curve.keypoints = study::keypoints(shape.target->mesh(), shape.target->half_edges(),
                                           curve.points, shape.curves.scale);
  } catch (const Error& error) {
    shape.problem = error.what();
  }
}

std::map<Index, MeasuredShape> load_shapes(const std::vector<Participant>& participants,
                                           const MeasureArguments& args) {
  const study::TargetSet set = load_targets(args.targets);
  const std::string file = std::filesystem::path(args.targets).filename().string();
  std::map<Index, MeasuredShape> shapes;
  for (const Participant& participant : participants)
    for (const Index number : participant.sequence.shapes) {
      if (shapes.contains(number)) continue;
      MeasuredShape& shape = shapes[number];
      if (static_cast<std::size_t>(number) >= study::kStudyShapes.size()) {
        shape.problem = "the study has no shape " + std::to_string(number);
        continue;
      }
      shape.name = std::string(study::kStudyShapes[static_cast<std::size_t>(number)]);
      load_shape(shape, args.shapes, set, file);
    }
  return shapes;
}

const char* const kFirstColumns[] = {"method", "shape", "index", "curve", "repeat", "task"};

std::string heading(bool all, bool participant, bool simulated) {
  std::vector<std::string> columns(std::begin(kFirstColumns), std::end(kFirstColumns));
  const auto add = [&](std::span<const std::string> more) {
    columns.insert(columns.end(), more.begin(), more.end());
  };
  add(io::measure_columns());
  columns.push_back("pieces");
  if (all) add(io::more_measure_columns());
  if (participant) columns.push_back("participant");
  if (simulated) columns.emplace_back("simulated");
  return io::csv_heading(columns);
}

class Measurer {
 public:
  Measurer(const MeasureArguments& args, const std::map<Index, MeasuredShape>& shapes,
           bool participant)
      : args_(args), shapes_(shapes), participant_(participant) {}

  Outcome run(const Job& job) const {
    Outcome outcome;
    const auto reject_file = [&](const std::string& reason) {
      outcome.rejected.push_back(
          {job.participant->name, job.method, job.shape, std::nullopt, reason});
    };
    const MeasuredShape& shape = shapes_.at(job.shape);
    if (!shape.problem.empty()) {
      reject_file(shape.problem);
      return outcome;
    }
    std::vector<study::RecordedStroke> strokes;
    try {
      strokes = load_recording(*job.participant, job.method, job.shape);
    } catch (const Error& error) {
      reject_file(error.what());
      return outcome;
    }
    const std::size_t expected = job.participant->sequence.trials(job.method, job.shape).size();
    for (std::size_t i = 0; i < std::max(strokes.size(), expected); ++i) {
      // Known once the stroke has said it.
      Index method = job.method;
      try {
        if (i >= strokes.size())
          throw Error(ErrorKind::invalid_input,
                      "is missing: the file has " + std::to_string(strokes.size()) +
                          " strokes, the sequence asks for " + std::to_string(expected));
        measure(job, shape, i, strokes[i], method, outcome);
      } catch (const Error& error) {
        outcome.rejected.push_back({job.participant->name, method, job.shape, i, error.what()});
      }
    }
    return outcome;
  }

 private:
  void measure(const Job& job, const MeasuredShape& shape, std::size_t i,
               const study::RecordedStroke& stroke, Index& method, Outcome& outcome) const {
    const Index said = study::method_number(study::method_of(stroke));
    if (said != kNone && said != method) {
      if (outcome.notes.empty())
        outcome.notes.push_back(job.participant->name + "/" +
                                recording_name(job.method, job.shape) + ": holds strokes of M '" +
                                study::method_of(stroke) + "', method " + std::to_string(said) +
                                "; they are measured as what M says");
      method = said;
    }
    std::vector<study::Trial> trials = job.participant->sequence.trials(method, job.shape);
    if (trials.empty()) trials = job.participant->sequence.trials(job.method, job.shape);
    if (i >= trials.size())
      throw Error(ErrorKind::invalid_input,
                  "the sequence asks for " + std::to_string(trials.size()) + " strokes only");
    const study::Trial& trial = trials[i];
    if (static_cast<std::size_t>(trial.curve) >= shape.curves.curves.size())
      throw Error(ErrorKind::invalid_input,
                  "the sequence asks for curve " + std::to_string(trial.curve) + " of " +
                      shape.name + ", which has " + std::to_string(shape.curves.curves.size()) +
                      " target curves");
    const std::vector<study::MotionSample> motion = study::motion_of(stroke);
    const curve::ProjectedCurve curve = study::curve_of(stroke, *shape.target);
    const TriangleMesh& mesh = shape.target->mesh();
    const study::IntendedCurve intended =
        study::intended_curve(mesh, shape.curves.curves[static_cast<std::size_t>(trial.curve)],
                              study::placement_of(stroke).scale);
    const study::Measures measures = study::measure(mesh, shape.target->half_edges(), intended,
                                                    curve, motion, {!args_.per_piece});
    std::vector<io::Cell> cells = {
        std::int64_t{method},         std::int64_t{job.shape},
        static_cast<std::int64_t>(i), std::int64_t{trial.curve},
        std::int64_t{trial.repeat},   std::string(study::task_name(trial.task))};
    const auto add = [&](const std::vector<io::Cell>& more) {
      cells.insert(cells.end(), more.begin(), more.end());
    };
    add(io::measure_cells(measures));
    cells.push_back(static_cast<std::int64_t>(study::piece_count(stroke)));
    if (args_.all) add(io::more_measure_cells(measures));
    if (participant_) cells.push_back(job.participant->name);
    cells.push_back(simulation_cell(stroke.simulated));
    outcome.rows.push_back(std::move(cells));
    outcome.failed_filters += measures.filters.passed() ? 0 : 1;
  }

  const MeasureArguments& args_;
  const std::map<Index, MeasuredShape>& shapes_;
  bool participant_;
};

std::string rejected_name(const std::string& out) {
  const std::filesystem::path path(out);
  return (path.parent_path() / (path.stem().string() + ".rejected.csv")).string();
}

std::string rejected_csv(const std::vector<Rejected>& rejected) {
  const std::vector<std::string> columns = {"participant", "method", "shape", "index", "reason"};
  std::string text = io::csv_heading(columns);
  const auto number = [](Index n) -> io::Cell {
    if (n == kNone) return std::monostate();
    return std::int64_t{n};
  };
  for (const Rejected& r : rejected) {
    io::Cell index;
    if (r.index) index = static_cast<std::int64_t>(*r.index);
    text += io::csv_line(
        std::vector<io::Cell>{r.participant, number(r.method), number(r.shape), index, r.reason});
  }
  return text;
}

void print_rejected(const Rejected& r) {
  std::string where = r.participant;
  if (r.shape != kNone) where += "/" + recording_name(r.method, r.shape);
  if (r.index) where += ": stroke " + std::to_string(*r.index);
  complain("left out: " + where + ": " + r.reason);
}

void run_measure(const MeasureArguments& args, int& status) {
  const auto output_lock = files::OutputLock::of_file(args.out);
  std::vector<Rejected> rejected;
  std::vector<Participant> participants;
  for (const std::string& folder : args.folders) try {
      participants.push_back(open_participant(folder));
    } catch (const Error& error) {
      rejected.push_back({folder, kNone, kNone, std::nullopt, error.what()});
    }
  const std::map<Index, MeasuredShape> shapes = load_shapes(participants, args);
  std::vector<Job> jobs;
  for (const Participant& participant : participants)
    for (const Index method : participant.sequence.methods)
      for (const Index shape : participant.sequence.shapes)
        jobs.push_back({&participant, method, shape});

  const bool several = args.all || args.folders.size() > 1;
  const Measurer measurer(args, shapes, several);
  std::vector<Outcome> outcomes(jobs.size());
  {
    ProgressLine progress("measuring");
    std::mutex lock;
    std::size_t done = 0;
    parallel_for(jobs.size(), thread_count(args.threads), [&](std::size_t i) {
      outcomes[i] = measurer.run(jobs[i]);
      const std::lock_guard guard(lock);
      progress.update(++done, jobs.size());
    });
  }

  bool simulated = false;
  for (const Outcome& outcome : outcomes)
    for (const auto& row : outcome.rows)
      simulated = simulated || !std::holds_alternative<std::monostate>(row.back());
  std::string rows = heading(args.all, several, simulated);
  std::size_t measured = 0, failed = 0;
  for (const Outcome& outcome : outcomes) {
    for (const auto& row : outcome.rows)
      rows += io::csv_line(std::span(row).first(row.size() - (simulated ? 0 : 1)));
    measured += outcome.rows.size();
    failed += outcome.failed_filters;
    rejected.insert(rejected.end(), outcome.rejected.begin(), outcome.rejected.end());
    for (const std::string& note : outcome.notes) complain(note);
  }
  for (const Rejected& r : rejected) print_rejected(r);
  files::write_file_atomically(args.out, rows);
  files::write_file_atomically(rejected_name(args.out), rejected_csv(rejected));
  std::printf("%s: %zu strokes, %zu of them short, noisy or inverted\n", args.out.c_str(), measured,
              failed);
  if (rejected.empty()) return;
  std::printf("%s: what was left out, %zu entries\n", rejected_name(args.out).c_str(),
              rejected.size());
  status = measured > 0 ? kPartly : kBadInput;
}

}  // namespace

void add_measure(CLI::App& app, int& status) {
  auto* command = app.add_subcommand("measure", "Measure the recorded curves of a study");
  auto args = std::make_shared<MeasureArguments>();
  command->add_option("participants", args->folders, "Folders, one for each participant")
      ->required();
  command->add_option("--shapes", args->shapes, "Folder of the shapes' meshes (torus.obj ...)")
      ->required();
  command->add_option("--targets", args->targets, "The file of target curves")->required();
  command->add_option("-o,--out", args->out, "The CSV file to write")->required();
  command->add_flag("--all", args->all, "More measures, and the participant, in further columns");
  command->add_flag("--per-piece", args->per_piece,
                    "K_E, K_g and F_g are sums over the pieces; what joins them does not count");
  add_threads_option(*command, args->threads);
  command->callback([args, &status] { run_measure(*args, status); });
}

}  // namespace mimicry::cli
