#include <algorithm>
#include <atomic>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <mimicry/base/error.h>
#include <mimicry/base/parallel.h>
#include <mimicry/files/file.h>
#include <mimicry/files/output_lock.h>
#include <mimicry/io/study_recording.h>
#include <mimicry/study/participants.h>

#include "cli/canvas.h"
#include "cli/commands.h"
#include "cli/console.h"
#include "cli/embedding_input.h"
#include "cli/interrupt.h"
#include "cli/simulated_drawing.h"
#include "cli/study_shapes.h"

namespace mimicry::cli {
namespace {

struct ParticipantsArguments {
  StudyShapeOptions shapes;
  std::vector<std::string> techniques = {"spraycan", "mimicry"};
  std::string out;
  Index count = 20;
  std::uint64_t seed = 1;
  double rate_hz = 90.0;
  int threads = 0;
};

// One method of the study: a technique under its number.
struct Method {
  Index number;
  std::string word;
  const technique::TechniqueInfo* technique;
};

std::vector<Method> methods_of(const std::vector<std::string>& names) {
  std::vector<Method> methods;
  Index next = study::kMimicry + 1;
  for (const std::string& name : names) {
    const technique::TechniqueInfo& info = technique::find_technique(name);
    const Index number = name == "spraycan"  ? Index{study::kSpraycan}
                         : name == "mimicry" ? Index{study::kMimicry}
                                             : next++;
    const std::string_view word = study::method_word(number);
    methods.push_back({number, word.empty() ? name : std::string(word), &info});
    for (std::size_t i = 0; i + 1 < methods.size(); ++i)
      if (methods[i].technique == &info)
        throw Error(ErrorKind::invalid_input, "--techniques: " + name + " is named twice");
  }
  return methods;
}

std::string folder_of(const ParticipantsArguments& args, Index number) {
  char name[32];
  std::snprintf(name, sizeof name, "p%02d", static_cast<int>(number));
  return (std::filesystem::path(args.out) / name).string();
}

// Each stroke of a study begins so much after the one before; no stroke takes as long.
constexpr double kStrokeSlot_s = 90.0;

struct Study {
  const ParticipantsArguments& args;
  std::vector<Method> methods;
  std::vector<study::StudySequence> sequences;  // of each participant
  study::PopulationOptions population;
};

study::RecordedStroke draw(const technique::Canvas& canvas, const StudyShape& shape,
                           const Method& method, const study::Trial& trial, const Study& study,
                           const study::Participant& person, std::uint64_t slot) {
  const study::TargetCurve& curve = shape.shape->curves[static_cast<std::size_t>(trial.curve)];
  const stroke::Intention intended{shape.shape->name + "-" + std::to_string(trial.curve), false,
                                   curve.points};
  const Similarity placed = placement(*canvas.target, shape.shape->scale, false);
  const SimulatedDrawing drawn =
      draw_simulated(canvas, *method.technique,
                     {intended, curve.keypoints, trial.task, placed, study.args.seed, slot},
                     study.population, person);
  study::RecordedStroke recorded = study::record(drawn.stroke, drawn.curve, method.word);
  for (study::RecordedPiece& piece : recorded.pieces)
    for (study::RecordedFrame& frame : piece.frames)
      frame.time_ms += 1e3 * kStrokeSlot_s * static_cast<double>(slot);
  return recorded;
}

// Everything that a participant draws on one shape.
void draw_shape(const technique::Canvas& canvas, const StudyShape& shape, std::size_t shape_at,
                const Study& study, Index number) {
  study::Participant person = study::participant(study.population, study.args.seed, number);
  person.hand.rate_hz = study.args.rate_hz;
  const study::StudySequence& sequence = study.sequences[static_cast<std::size_t>(number)];
  for (const Method& method : study.methods) {
    const auto method_at = static_cast<std::size_t>(
        std::find(sequence.methods.begin(), sequence.methods.end(), method.number) -
        sequence.methods.begin());
    const auto trials = sequence.trials(method.number, shape.number);
    std::vector<study::RecordedStroke> strokes;
    std::uint64_t slot = 0;
    for (const auto& list : sequence.strokes) slot += method_at * list.size();
    for (std::size_t s = 0; s < shape_at; ++s) slot += sequence.strokes[s].size();
    for (const study::Trial& trial : trials) {
      end_if_requested();
      strokes.push_back(draw(canvas, shape, method, trial, study, person, slot++));
    }
    files::write_file_atomically(
        (std::filesystem::path(folder_of(study.args, number)) /
         (std::to_string(method.number) + "_" + std::to_string(shape.number) + ".json"))
            .string(),
        io::write_recording(strokes));
  }
}

void run_participants(const ParticipantsArguments& args) {
  const StudyShapes shapes(args.shapes);
  Study study{args, methods_of(args.techniques), {}, {}};
  const auto output_lock = files::OutputLock::of_folder(args.out);
  std::vector<Index> method_numbers, shape_numbers, curve_counts;
  for (const Method& m : study.methods) method_numbers.push_back(m.number);
  for (const StudyShape& s : shapes.list()) {
    shape_numbers.push_back(s.number);
    curve_counts.push_back(static_cast<Index>(s.shape->curves.size()));
  }
  for (Index p = 0; p < args.count; ++p) {
    study.sequences.push_back(
        study::study_sequence(method_numbers, shape_numbers, curve_counts, args.seed, p));
    files::make_folder(folder_of(args, p));
  }
  std::vector<const technique::TechniqueInfo*> techniques;
  for (const Method& m : study.methods) techniques.push_back(m.technique);

  Executor executor(thread_count(args.threads));
  ProgressLine progress("drawing");
  const auto count = static_cast<std::size_t>(args.count);
  std::size_t strokes = 0;
  for (std::size_t s = 0; s < shapes.list().size(); ++s) {
    const StudyShape& shape = shapes.list()[s];
    const spatial::Target target = shapes.load(shape);
    const PreparedCanvas prepared(target, techniques);
    std::atomic<std::size_t> done = 0;
    executor.for_chunks(count, 1, [&](std::size_t p, std::size_t, int worker) {
      draw_shape(prepared.canvas(), shape, s, study, static_cast<Index>(p));
      ++done;
      if (worker == 0) progress.update(s * count + done, shapes.list().size() * count);
    });
    for (const auto& sequence : study.sequences)
      strokes += study.methods.size() * sequence.strokes[s].size();
  }
  // The sequence comes last: a folder that has it is whole.
  for (Index p = 0; p < args.count; ++p)
    files::write_file_atomically(
        (std::filesystem::path(folder_of(args, p)) / "study_sequence.json").string(),
        io::write_study_sequence(study.sequences[static_cast<std::size_t>(p)]));
  std::printf("%s: %d participants, %zu strokes\n", args.out.c_str(), static_cast<int>(args.count),
              strokes);
}

}  // namespace

void add_participants(CLI::App& app, int&) {
  auto* command = app.add_subcommand(
      "participants", "Let simulated participants do the whole study; writes their recordings");
  auto args = std::make_shared<ParticipantsArguments>();
  add_study_shape_options(*command, args->shapes);
  command->add_option("-t,--techniques", args->techniques, "The study's methods, one or more")
      ->delimiter(',')
      ->capture_default_str();
  command->add_option("-o,--out", args->out, "Folder; a folder for each participant comes there")
      ->required();
  command->add_option("--count", args->count, "Participants")
      ->check(CLI::Range(1, 9999))
      ->capture_default_str();
  command->add_option("--seed", args->seed, "Of all that is random")->capture_default_str();
  command->add_option("--rate", args->rate_hz, "Frames a second")
      ->check(number_between(20, 1000))
      ->capture_default_str();
  add_threads_option(*command, args->threads);
  command->callback([args] { run_participants(*args); });
}

}  // namespace mimicry::cli
