#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <mimicry/base/error.h>
#include <mimicry/files/file.h>
#include <mimicry/files/output_lock.h>
#include <mimicry/io/strokes.h>
#include <mimicry/mesh/shapes.h>
#include <mimicry/session/stroke_session.h>
#include <mimicry/study/intended_curves.h>
#include <mimicry/study/simulate.h>

#include "cli/canvas.h"
#include "cli/commands.h"
#include "cli/console.h"
#include "cli/mesh_input.h"
#include "cli/simulated_drawing.h"
#include "cli/study_shapes.h"
#include "cli/target_curves.h"

namespace mimicry::cli {
namespace {

struct SimulateArguments {
  std::string mesh;
  std::string shape;
  std::string targets;
  std::string out;
  std::vector<std::string> curves;
  std::vector<std::string> closed_loop;  // techniques whose ink is seen
  int count = 1;
  std::uint64_t seed = 1;
  double rate_hz = 90.0;
  double distance_m = 0.048;
  double scale = 0.0;  // metres per mesh unit
  std::string up = "y";
  spatial::TargetOptions target;
};

struct Task {
  std::vector<stroke::Intention> curves;
  double metres_per_unit;
};

Task published_curves(const SimulateArguments& args, const NamedMesh& named) {
  const study::TargetSet set = load_targets(args.targets);
  const std::string wanted =
      args.shape.empty() ? std::filesystem::path(named.name).stem().string() : args.shape;
  const study::TargetShape& shape = find_target_shape(set, wanted, args.targets);
  study::require_fits(shape, named.mesh);
  Task task{{}, shape.scale};
  for (std::size_t i = 0; i < shape.curves.size(); ++i)
    task.curves.push_back({wanted + "-" + std::to_string(i), false, shape.curves[i].points});
  return task;
}

// The curves are laid out in the shape's own coordinates: the mesh must be that shape, at any
// resolution, not a scaled or moved one.
void require_same_size(const NamedMesh& named, const spatial::Target& target,
                       const std::string& shape) {
  const Eigen::AlignedBox3d own = bounding_box(make_shape(shape));
  const double off = std::max((own.min() - target.bounding_box().min()).cwiseAbs().maxCoeff(),
                              (own.max() - target.bounding_box().max()).cwiseAbs().maxCoeff());
  // A coarse mesh of a round shape, or a noisy one, differs by some per cent.
  if (off > 0.1 * own.diagonal().norm())
    throw Error(ErrorKind::invalid_input,
                named.name + ": is not the built-in shape '" + shape +
                    "' (its bounding box is another); simulate on shape:" + shape +
                    ", or give --targets FILE with curves of this mesh");
}

Task task_of(const SimulateArguments& args, const NamedMesh& named, const spatial::Target& target) {
  if (!args.targets.empty()) return published_curves(args, named);
  const std::string shape = args.shape.empty() ? named.name : args.shape;
  const ShapeInfo* info = find_shape(shape);
  if (info == nullptr)
    throw Error(ErrorKind::invalid_input,
                named.name +
                    ": there are no intended curves for it; give --targets FILE with target "
                    "curves, or --shape NAME if it is a built-in shape");
  require_same_size(named, target, shape);
  return {study::intended_curves(shape, target), info->metres_per_unit};
}

// technique: whose ink the person sees; null: none's. All techniques get the same hand.
stroke::Stroke make_stroke(const technique::Canvas& canvas, const stroke::Intention& intended,
                           const Similarity& placed, const SimulateArguments& args,
                           std::uint64_t number, const technique::TechniqueInfo* technique) {
  study::SimulationOptions options;
  options.rate_hz = args.rate_hz;
  options.mean_distance_m = args.distance_m;
  const std::uint64_t seed = args.seed + number;
  stroke::Stroke stroke;
  if (technique == nullptr) {
    stroke = study::simulate(*canvas.target, intended, placed, options, seed);
  } else {
    session::StrokeSession session(canvas, *technique);
    session.begin(placed);
    stroke =
        study::simulate_closed_loop(*canvas.target, intended, placed, options, seed,
                                    [&](const stroke::Frame& frame) -> std::optional<Vec3> {
                                      if (session.add(frame) != session::FrameStatus::inked)
                                        return std::nullopt;
                                      return placed.point(session.curve().points.back().position);
                                    });
  }
  stroke.simulated = simulation_mark(args.seed, technique == nullptr ? "" : technique->name);
  return stroke;
}

bool is_chosen(const std::vector<std::string>& chosen, const std::string& name) {
  if (chosen.empty()) return true;
  for (const std::string& c : chosen)
    if (c == name) return true;
  return false;
}

void run_simulate(const SimulateArguments& args) {
  const auto output_lock = files::OutputLock::of_file(args.out);
  const NamedMesh named = load_mesh(args.mesh);
  const spatial::Target target = make_target(named, args.target);
  const Task task = task_of(args, named, target);
  const double scale = args.scale > 0.0 ? args.scale : task.metres_per_unit;
  const Similarity placed = placement(target, scale, args.up == "z");
  const std::vector<const technique::TechniqueInfo*> seen =
      args.closed_loop.empty() ? std::vector<const technique::TechniqueInfo*>{nullptr}
                               : chosen_techniques(args.closed_loop);
  std::vector<const technique::TechniqueInfo*> needed = seen;
  std::erase(needed, nullptr);
  const PreparedCanvas prepared(target, needed);

  std::vector<stroke::Stroke> strokes;
  ProgressLine progress("drawing");
  std::size_t total = 0;
  for (const auto& curve : task.curves)
    if (is_chosen(args.curves, curve.name)) total += static_cast<std::size_t>(args.count);
  total *= seen.size();
  for (const technique::TechniqueInfo* technique : seen)
    for (std::size_t c = 0; c < task.curves.size(); ++c) {
      if (!is_chosen(args.curves, task.curves[c].name)) continue;
      for (int k = 0; k < args.count; ++k) {
        // A curve's strokes stay the same when others are left out.
        const std::uint64_t number = 1000 * c + static_cast<std::uint64_t>(k);
        strokes.push_back(
            make_stroke(prepared.canvas(), task.curves[c], placed, args, number, technique));
        strokes.back().target = named.name;
        if (args.count > 1) strokes.back().id += "#" + std::to_string(k);
        if (seen.size() > 1) strokes.back().id += "@" + std::string(technique->name);
        progress.update(strokes.size(), total);
      }
    }
  if (strokes.empty()) {
    std::string names;
    for (const auto& curve : task.curves) names += (names.empty() ? "" : ", ") + curve.name;
    throw Error(ErrorKind::invalid_input, "simulate: no such curve; there are " + names);
  }
  files::write_file_atomically(args.out, io::write_strokes(strokes));
  std::size_t frames = 0;
  for (const auto& stroke : strokes) frames += stroke.frames.size();
  std::printf("%s: %zu strokes, %zu frames\n", args.out.c_str(), strokes.size(), frames);
}

}  // namespace

void add_simulate(CLI::App& app, int&) {
  auto* command = app.add_subcommand(
      "simulate", "Make mid-air strokes as a person would who means given curves");
  auto args = std::make_shared<SimulateArguments>();
  command->add_option("mesh", args->mesh, kMeshHelp)->required();
  command->add_option("--shape", args->shape,
                      "Whose intended curves: of a built-in shape, or a name in --targets");
  command->add_option("--targets", args->targets, "A file of target curves on the mesh");
  command->add_option("-o,--out", args->out, "The mimicry-strokes file to write")->required();
  command->add_option("--curves", args->curves, "Only these intended curves")->delimiter(',');
  command->add_option("--count", args->count, "Strokes for each curve")
      ->check(CLI::Range(1, 999))
      ->capture_default_str();
  command->add_option("--seed", args->seed, "Of all that is random")->capture_default_str();
  command->add_option("--rate", args->rate_hz, "Frames a second")
      ->check(number_between(20, 1000))
      ->capture_default_str();
  command->add_option("--distance", args->distance_m, "Mean distance from hand to surface, metres")
      ->capture_default_str();
  command
      ->add_option("--closed-loop", args->closed_loop,
                   "The person sees the ink of these techniques, or all, and corrects the visible "
                   "error; strokes for each")
      ->delimiter(',');
  command->add_option("--up", args->up, "The axis that points up in the mesh file: y or z")
      ->check(CLI::IsMember({"y", "z"}))
      ->capture_default_str();
  add_target_options(*command, args->target);
  command->add_option("--scale", args->scale, "Metres per mesh unit (default: the shape's own)")
      ->check(number_between(1e-12, 1e12));
  command->callback([args] { run_simulate(*args); });
}

}  // namespace mimicry::cli
