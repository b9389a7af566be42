#include "cli/report/drawn_strokes.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include <mimicry/base/error.h>
#include <mimicry/files/file.h>
#include <mimicry/io/number.h>
#include <mimicry/io/strokes.h>
#include <mimicry/io/study_recording.h>
#include <mimicry/session/stroke_session.h>

#include "cli/mesh_input.h"
#include "cli/participant.h"
#include "cli/study_shapes.h"
#include "cli/target_curves.h"

namespace mimicry::cli {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse_row(const std::string& what) {
  throw Error(ErrorKind::invalid_input, what);
}

std::size_t number_of(const std::string& cell, const char* what) {
  const auto number = io::parse_integer(cell);
  if (!number || *number < 0) refuse_row(std::string("the row has no ") + what);
  return static_cast<std::size_t>(*number);
}

}  // namespace

DrawnStrokes::DrawnStrokes(const StrokeSources& sources) : sources_(sources) {
  if (!sources.targets.empty()) targets_ = load_targets(sources.targets);
}

DrawnStroke DrawnStrokes::find(const StudyRow& row) {
  return row.stroke.empty() ? recorded(row) : replayed(row);
}

DrawnStrokes::Shape& DrawnStrokes::shape(const std::string& name) {
  Shape& entry = shapes_[name];
  if (!entry.target)
    entry.target = std::make_unique<spatial::Target>(make_target(
        load_mesh(sources_.mesh.empty() ? mesh_spec(sources_.shapes, name) : sources_.mesh)));
  return entry;
}

// Of the participant's folder, or the strokes file.
std::string DrawnStrokes::path_of(const StudyRow& row) const {
  const auto known = sources_.files.find(row.participant);
  if (known == sources_.files.end())
    return (fs::path(sources_.recordings) / row.participant).string();
  if (known->second.empty())
    refuse_row("several strokes that were replayed are called " + row.participant +
               "; say which with --recordings");
  std::error_code none;
  if (!fs::exists(known->second, none))
    refuse_row(known->second +
               ": is no longer where it was replayed from; say where with --recordings");
  return known->second;
}

const study::RecordedStroke& DrawnStrokes::recording(const StudyRow& row, const std::string& file) {
  const std::string path = (fs::path(path_of(row)) / file).string();
  auto found = recordings_.find(path);
  if (found == recordings_.end())
    found = recordings_.emplace(path, io::read_recording(files::read_file(path), path)).first;
  const std::size_t index = number_of(row.index, "index");
  if (index >= found->second.size())
    refuse_row(path + ": has only " + std::to_string(found->second.size()) + " strokes");
  return found->second[index];
}

const stroke::Stroke& DrawnStrokes::stroke_of_file(const StudyRow& row) {
  const std::string path = path_of(row);
  auto found = files_.find(path);
  if (found == files_.end())
    found = files_.emplace(path, io::read_strokes(files::read_file(path), path)).first;
  const std::size_t index = number_of(row.index, "index");
  const io::StrokesFile& file = found->second;
  const auto at = std::find(file.numbers.begin(), file.numbers.end(), index);
  if (at == file.numbers.end()) refuse_row(path + ": has no sound stroke " + std::to_string(index));
  return file.strokes[static_cast<std::size_t>(at - file.numbers.begin())];
}

std::vector<Vec3> DrawnStrokes::target_curve(const StudyRow& row, const TriangleMesh& mesh) const {
  std::vector<Vec3> points;
  const study::TargetShape* shape = targets_ ? targets_->find(row.shape) : nullptr;
  if (shape == nullptr || row.curve.empty()) return points;
  const std::size_t number = number_of(row.curve, "curve");
  if (number >= shape->curves.size()) return points;
  study::require_fits(*shape, mesh);
  for (const SurfacePoint& p : shape->curves[number].points) points.push_back(mesh.position(p));
  return points;
}

DrawnStroke DrawnStrokes::recorded(const StudyRow& row) {
  const Index method = static_cast<Index>(number_of(row.method_cell, "number of the method"));
  const Index number = static_cast<Index>(number_of(row.shape_cell, "number of the shape"));
  const std::string file = recording_name(method, number);
  const study::RecordedStroke& recorded = recording(row, file);
  const std::string& word = study::method_of(recorded);
  const Index said = study::method_number(word);
  if (said != kNone && said != method) refuse_row(file + " holds strokes of M '" + word + "'");
  DrawnStroke drawn;
  drawn.target = shape(row.shape).target.get();
  drawn.stroke = study::stroke_of(recorded);
  drawn.curve = study::curve_of(recorded, *drawn.target);
  drawn.intended = target_curve(row, drawn.target->mesh());
  return drawn;
}

DrawnStroke DrawnStrokes::replayed(const StudyRow& row) {
  DrawnStroke drawn;
  // Strokes of a participant are called "0_3.json#7".
  const std::size_t hash = row.stroke.find(".json#");
  const bool of_folder = hash != std::string::npos && fs::is_directory(path_of(row));
  drawn.stroke = of_folder ? study::stroke_of(recording(row, row.stroke.substr(0, hash + 5)))
                           : stroke_of_file(row);
  Shape& on = shape(row.shape);
  drawn.target = on.target.get();
  const technique::TechniqueInfo& info = technique::find_technique(row.method);
  const technique::TechniqueInfo* only[] = {&info};
  auto& prepared = info.needs_bake ? on.baked : on.plain;
  if (!prepared) prepared = std::make_unique<PreparedCanvas>(*on.target, only);
  session::SessionOptions options;
  options.misses = sources_.misses;
  options.expected_frames = drawn.stroke.frames.size();
  session::StrokeSession session(prepared->canvas(), info, options);
  session.begin(drawn.stroke.model_to_world);
  for (const stroke::Frame& frame : drawn.stroke.frames) session.add(frame);
  session.end();
  drawn.curve = session.curve();
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

}  // namespace mimicry::cli
