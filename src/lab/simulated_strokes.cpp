#include "lab/simulated_strokes.h"

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include <mimicry/assets/canvas.h>
#include <mimicry/assets/files.h>
#include <mimicry/base/error.h>
#include <mimicry/mesh/shapes.h>
#include <mimicry/session/stroke_session.h>
#include <mimicry/study/simulate.h>
#include <mimicry/study/targets.h>

#include "assets/target_curves.h"
#include "base/comma_list.h"
#include "files/names.h"
#include "lab/simulated_drawing.h"
#include "lab/study_shapes.h"
#include "study/simulation_mark.h"

namespace mimicry::lab {
namespace {

struct Task {
  std::vector<Intention> curves;
  double metres_per_unit;
};

Task published_curves(const SimulatedStrokesOptions& options, const NamedMesh& named) {
  const TargetSet set = load_target_curves(options.targets);
  const std::string wanted = options.shape.empty() ? file_stem(named.name) : options.shape;
  const TargetShape& shape = find_target_shape(set, wanted, options.targets);
  require_fits(shape, named.mesh);
  Task task{{}, shape.scale};
  for (std::size_t i = 0; i < shape.curves.size(); ++i)
    task.curves.push_back({wanted + "-" + std::to_string(i), false, shape.curves[i].points});
  return task;
}

// The curves are laid out in the shape's own coordinates: the mesh must be that shape, at any
// resolution, not a scaled or moved one.
void require_same_size(const NamedMesh& named, const Target& target, const std::string& shape) {
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

Task task_of(const SimulatedStrokesOptions& options, const NamedMesh& named, const Target& target) {
  if (!options.targets.empty()) return published_curves(options, named);
  const std::string shape = options.shape.empty() ? named.name : options.shape;
  const ShapeInfo* info = find_shape(shape);
  if (info == nullptr)
    throw Error(ErrorKind::invalid_input,
                named.name +
                    ": there are no intended curves for it; give --targets FILE with target "
                    "curves, or --shape NAME if it is a built-in shape");
  require_same_size(named, target, shape);
  return {intended_curves(shape, target), info->metres_per_unit};
}

// technique: whose ink the person sees; null: none's. All techniques get the same hand.
Stroke make_stroke(const Canvas& canvas, const Intention& intended, const Similarity& placed,
                   const SimulatedStrokesOptions& options, std::uint64_t number,
                   const TechniqueInfo* technique) {
  SimulationOptions hand;
  hand.rate_hz = options.rate_hz;
  hand.mean_distance_m = options.distance_m;
  const std::uint64_t seed = options.seed + number;
  Stroke stroke;
  if (technique == nullptr) {
    stroke = simulate(canvas.target, intended, placed, hand, seed);
  } else {
    StrokeSession session(canvas, *technique);
    session.begin(placed);
    stroke = simulate_closed_loop(canvas.target, intended, placed, hand, seed,
                                  [&](const Frame& frame) { return session.ink(frame); });
  }
  stroke.simulated = simulation_mark(options.seed, technique == nullptr ? "" : technique->name);
  return stroke;
}

bool is_chosen(const std::vector<std::string>& chosen, const std::string& name) {
  if (chosen.empty()) return true;
  for (const std::string& c : chosen)
    if (c == name) return true;
  return false;
}

}  // namespace

std::vector<Stroke> simulated_strokes(const SimulatedStrokesOptions& options,
                                      const Monitor& monitor) {
  const NamedMesh named = load_mesh(options.mesh, monitor);
  const Target target = make_target(named, options.target, monitor);
  const Task task = task_of(options, named, target);
  const double scale = options.scale > 0.0 ? options.scale : task.metres_per_unit;
  const Similarity placed = placement(target, scale, options.z_up);
  std::vector<const TechniqueInfo*> seen = options.closed_loop;
  if (seen.empty()) seen.push_back(nullptr);
  const Canvas canvas = make_canvas(target, options.closed_loop, monitor);

  std::vector<Stroke> strokes;
  std::size_t total = 0;
  for (const auto& curve : task.curves)
    if (is_chosen(options.curves, curve.name)) total += static_cast<std::size_t>(options.count);
  total *= seen.size();
  for (const TechniqueInfo* technique : seen)
    for (std::size_t c = 0; c < task.curves.size(); ++c) {
      if (!is_chosen(options.curves, task.curves[c].name)) continue;
      for (int k = 0; k < options.count; ++k) {
        // A curve's strokes stay the same when others are left out.
        const std::uint64_t number = 1000 * c + static_cast<std::uint64_t>(k);
        strokes.push_back(make_stroke(canvas, task.curves[c], placed, options, number, technique));
        strokes.back().target = named.name;
        if (options.count > 1) strokes.back().id += "#" + std::to_string(k);
        if (seen.size() > 1) strokes.back().id += "@" + std::string(technique->name);
        monitor.report("drawing", strokes.size(), total);
      }
    }
  if (strokes.empty()) {
    const auto name = [](const Intention& curve) { return curve.name; };
    throw Error(ErrorKind::invalid_input,
                "simulate: no such curve; there are " + comma_list(task.curves, name));
  }
  return strokes;
}

}  // namespace mimicry::lab
