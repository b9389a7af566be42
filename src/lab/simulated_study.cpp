#include "lab/simulated_study.h"

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <filesystem>

#include <mimicry/assets/canvas.h>
#include <mimicry/base/error.h>
#include <mimicry/base/parallel.h>
#include <mimicry/study/simulate.h>

#include "assets/work.h"
#include "files/names.h"
#include "files/output_lock.h"
#include "lab/participant_folder.h"
#include "lab/simulated_drawing.h"
#include "lab/study_numbers.h"

namespace mimicry::lab {
namespace {

// One method of the study: a technique under its number.
struct Method {
  Index number;
  std::string word;
  const TechniqueInfo* technique;
};

std::vector<Method> methods_of(const std::vector<std::string>& names) {
  std::vector<Method> methods;
  Index next = kMimicry + 1;
  for (const std::string& name : names) {
    const TechniqueInfo& info = find_technique(name);
    const Index known = number_of_method(name);
    const Index number = known == kNone ? next++ : known;
    const std::string_view word = method_word(number);
    for (const Method& other : methods)
      if (other.technique == &info)
        throw Error(ErrorKind::invalid_input, "--techniques: " + name + " is named twice");
    methods.push_back({number, word.empty() ? name : std::string(word), &info});
  }
  return methods;
}

std::string folder_of(const SimulatedStudyOptions& options, Index number) {
  char name[32];
  std::snprintf(name, sizeof name, "p%02d", static_cast<int>(number));
  return join_path(options.out, name);
}

// Each stroke of a study begins so much after the one before; no stroke takes as long.
constexpr double kStrokeSlot_s = 90.0;

struct Person {
  Participant who;
  StudySequence sequence;
  ParticipantWriter folder;
};

struct Study {
  const SimulatedStudyOptions& options;
  std::vector<Method> methods;
  PopulationOptions population;
  std::vector<Person> people;
};

RecordedStroke draw(const Canvas& canvas, const StudyShape& shape, const Method& method,
                    const Trial& trial, const Study& study, const Person& person,
                    std::uint64_t slot) {
  const TargetCurve& curve = shape.shape->curves[static_cast<std::size_t>(trial.curve)];
  const Intention intended{shape.shape->name + "-" + std::to_string(trial.curve), false,
                           curve.points};
  const Similarity placed = placement(canvas.target, shape.shape->scale, false);
  const SimulatedDrawing drawn =
      draw_simulated(canvas, *method.technique,
                     {intended, curve.keypoints, trial.task, placed, study.options.seed, slot},
                     study.population, person.who);
  RecordedStroke recorded = record(drawn.stroke, drawn.curve, method.word);
  for (RecordedPiece& piece : recorded.pieces)
    for (RecordedFrame& frame : piece.frames)
      frame.time_ms += 1e3 * kStrokeSlot_s * static_cast<double>(slot);
  return recorded;
}

// Everything that a participant draws on one shape.
void draw_shape(const Canvas& canvas, const StudyShape& shape, std::size_t shape_at,
                const Study& study, const Person& person, const Monitor& monitor) {
  const StudySequence& sequence = person.sequence;
  for (const Method& method : study.methods) {
    const auto method_at = static_cast<std::size_t>(
        std::find(sequence.methods.begin(), sequence.methods.end(), method.number) -
        sequence.methods.begin());
    std::vector<RecordedStroke> strokes;
    std::uint64_t slot = 0;
    for (const auto& list : sequence.strokes) slot += method_at * list.size();
    for (std::size_t s = 0; s < shape_at; ++s) slot += sequence.strokes[s].size();
    for (const Trial& trial : sequence.trials(method.number, shape.number)) {
      monitor.check();
      strokes.push_back(draw(canvas, shape, method, trial, study, person, slot++));
    }
    person.folder.write({method.number, shape.number}, strokes);
  }
}

std::vector<Person> people_of(const Study& study, const StudyShapes& shapes) {
  std::vector<Index> method_numbers, shape_numbers, curve_counts;
  for (const Method& m : study.methods) method_numbers.push_back(m.number);
  for (const StudyShape& s : shapes.list()) {
    shape_numbers.push_back(s.number);
    curve_counts.push_back(static_cast<Index>(s.shape->curves.size()));
  }
  std::vector<Person> people;
  for (Index p = 0; p < study.options.count; ++p) {
    StudySequence sequence =
        study_sequence(method_numbers, shape_numbers, curve_counts, study.options.seed, p);
    people.push_back({participant(study.population, study.options.seed, p), std::move(sequence),
                      ParticipantWriter(folder_of(study.options, p))});
    people.back().who.hand.rate_hz = study.options.rate_hz;
  }
  return people;
}

}  // namespace

std::size_t simulate_study(const SimulatedStudyOptions& options, const Monitor& monitor) {
  const StudyShapes shapes(options.shapes);
  Study study{options, methods_of(options.techniques), {}, {}};
  const auto output_lock = OutputLock::of_folder(options.out);
  study.people = people_of(study, shapes);
  std::vector<const TechniqueInfo*> techniques;
  for (const Method& m : study.methods) techniques.push_back(m.technique);

  Executor executor(thread_count(options.threads));
  const std::size_t count = study.people.size();
  std::size_t strokes = 0;
  for (std::size_t s = 0; s < shapes.list().size(); ++s) {
    const StudyShape& shape = shapes.list()[s];
    const Target target = shapes.load(shape, monitor);
    const Canvas canvas =
        make_canvas(target, techniques, monitor, {}, {.options = {}, .threads = options.threads});
    std::atomic<std::size_t> done = 0;
    executor.for_chunks(count, 1, [&](std::size_t p, std::size_t, int worker) {
      draw_shape(canvas, shape, s, study, study.people[p], monitor);
      ++done;
      if (worker == 0) monitor.report("drawing", s * count + done, shapes.list().size() * count);
    });
    for (const Person& person : study.people)
      strokes += study.methods.size() * person.sequence.strokes[s].size();
  }
  for (const Person& person : study.people) person.folder.finish(person.sequence);
  return strokes;
}

}  // namespace mimicry::lab
