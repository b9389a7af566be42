#include "lab/drawn_strokes.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include <mimicry/assets/canvas.h>
#include <mimicry/assets/files.h>
#include <mimicry/base/error.h>
#include <mimicry/io/strokes.h>
#include <mimicry/io/study.h>

#include "assets/meshes.h"
#include "files/file.h"
#include "files/names.h"
#include "io/number.h"
#include "lab/participant_folder.h"
#include "lab/replay_settings.h"
#include "lab/study_numbers.h"

namespace mimicry::lab {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse_row(const std::string& what) {
  throw Error(ErrorKind::invalid_input, what);
}

std::size_t number_of(const std::string& cell, const char* what) {
  const auto number = parse_integer(cell);
  if (!number || *number < 0) refuse_row(std::string("the row has no ") + what);
  return static_cast<std::size_t>(*number);
}

}  // namespace

void add_replay_sources(const std::string& folder, StrokeSources& sources) {
  const auto settings = read_settings(folder);
  if (!settings) return;
  if (sources.recordings.empty())
    for (const std::string& at : settings->strokes) {
      const auto [entry, is_new] = sources.files.emplace(source_name(at), at);
      if (!is_new && entry->second != at) entry->second.clear();  // two of this name
    }
  if (sources.shapes.empty()) {
    sources.shapes = settings->shapes;
    sources.mesh = settings->mesh;
  }
  if (sources.targets.empty()) sources.targets = settings->targets;
  if (settings->misses == MissPolicy::split) sources.misses = settings->misses;
}

DrawnStrokes::DrawnStrokes(const StrokeSources& sources, const Monitor& monitor, int threads)
    : sources_(sources), monitor_(monitor), threads_(threads) {
  if (!sources.targets.empty()) targets_ = load_target_curves(sources.targets);
}

DrawnStroke DrawnStrokes::find(const StudyRow& row) {
  return row.stroke.empty() ? recorded(row) : replayed(row);
}

DrawnStrokes::Shape& DrawnStrokes::shape(const std::string& name) {
  Shape& entry = shapes_[name];
  if (!entry.target) {
    const NamedMesh named = load_mesh(
        sources_.mesh.empty() ? mesh_spec(sources_.shapes, name) : sources_.mesh, monitor_);
    entry.target = std::make_unique<Target>(make_target(named, {}, monitor_));
  }
  return entry;
}

// Of the participant's folder, or the strokes file.
std::string DrawnStrokes::path_of(const StudyRow& row) const {
  const auto known = sources_.files.find(row.participant);
  if (known == sources_.files.end()) return join_path(sources_.recordings, row.participant);
  if (known->second.empty())
    refuse_row("several strokes that were replayed are called " + row.participant +
               "; say which with --recordings");
  if (!fs::exists(status_of(known->second)))
    refuse_row(known->second +
               ": is no longer where it was replayed from; say where with --recordings");
  return known->second;
}

const RecordedStroke& DrawnStrokes::recording(const StudyRow& row) {
  const std::string path = join_path(path_of(row), row.recording);
  auto found = recordings_.find(path);
  if (found == recordings_.end())
    found = recordings_.emplace(path, read_recording(read_file(path), path)).first;
  const std::size_t index = number_of(row.index, "index");
  if (index >= found->second.size())
    refuse_row(path + ": has only " + std::to_string(found->second.size()) + " strokes");
  return found->second[index];
}

const Stroke& DrawnStrokes::stroke_of_file(const StudyRow& row) {
  const std::string path = path_of(row);
  auto found = files_.find(path);
  if (found == files_.end())
    found = files_.emplace(path, read_strokes(read_file(path), path)).first;
  const std::size_t index = number_of(row.index, "index");
  const StrokesFile& file = found->second;
  const auto at = std::find(file.numbers.begin(), file.numbers.end(), index);
  if (at == file.numbers.end()) refuse_row(path + ": has no sound stroke " + std::to_string(index));
  return file.strokes[static_cast<std::size_t>(at - file.numbers.begin())];
}

std::vector<Vec3> DrawnStrokes::target_curve(const StudyRow& row, const TriangleMesh& mesh) const {
  std::vector<Vec3> points;
  const TargetShape* shape = targets_ ? targets_->find(row.shape) : nullptr;
  if (shape == nullptr || row.curve.empty()) return points;
  const std::size_t number = number_of(row.curve, "curve");
  if (number >= shape->curves.size()) return points;
  require_fits(*shape, mesh);
  for (const SurfacePoint& p : shape->curves[number].points) points.push_back(mesh.position(p));
  return points;
}

DrawnStroke DrawnStrokes::recorded(const StudyRow& row) {
  if (!RecordingName::of_file(row.recording)) refuse_row("the row does not say which recording");
  const RecordedStroke& recorded = recording(row);
  const std::string& word = method_of(recorded);
  const Index said = method_number(word);
  if (said != kNone && said != number_of_method(row.method))
    refuse_row(row.recording + " holds strokes of M '" + word + "'");
  DrawnStroke drawn;
  drawn.target = shape(row.shape).target.get();
  drawn.stroke = stroke_of(recorded);
  drawn.curve = curve_of(recorded, *drawn.target);
  drawn.intended = target_curve(row, drawn.target->mesh());
  return drawn;
}

DrawnStroke DrawnStrokes::replayed(const StudyRow& row) {
  DrawnStroke drawn;
  // A strokes file may have strokes of such names.
  const bool of_folder =
      RecordingName::of_file(row.recording) && fs::is_directory(status_of(path_of(row)));
  drawn.stroke = of_folder ? stroke_of(recording(row)) : stroke_of_file(row);
  Shape& on = shape(row.shape);
  drawn.target = on.target.get();
  const TechniqueInfo& info = find_technique(row.method);
  const TechniqueInfo* only[] = {&info};
  auto& prepared = info.needs_bake ? on.baked : on.plain;
  if (!prepared)
    prepared = make_canvas(*on.target, only, monitor_, {}, {.options = {}, .threads = threads_});
  drawn.curve = project(*prepared, info, drawn.stroke, {.misses = sources_.misses}).curve;
  if (drawn.stroke.intended)
    for (const SurfacePoint& p : drawn.stroke.intended->points) {
      if (p.face >= drawn.target->mesh().face_count())
        refuse_row("its intended curve is on another mesh");
      drawn.intended.push_back(drawn.target->mesh().position(p));
    }
  else
    drawn.intended = target_curve(row, drawn.target->mesh());
  return drawn;
}

}  // namespace mimicry::lab
