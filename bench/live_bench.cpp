// mimicry-live beside anchored-closest on simulated strokes, in one process on one thread: time of
// a step, distance of the curve from the intended one, smoothness. Three hands: a steady one that
// follows the intended curve translated, one that follows an offset of it where that fits better
// (both open loop, the same strokes for all), and one that corrects what it sees (closed loop). A
// step's time is the least of five passes over its stroke, which leaves out what the machine does
// besides; the clock's own 20 to 30 ns are in it.

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <mimicry/io/meshes.h>
#include <mimicry/io/study.h>
#include <mimicry/mesh/shapes.h>
#include <mimicry/study/simulate.h>
#include <mimicry/study/targets.h>
#include <mimicry/technique/technique.h>

#include "files/file.h"
#include "study/polyline.h"

namespace {

using namespace mimicry;
using Clock = std::chrono::steady_clock;

constexpr int kPasses = 5;
constexpr double kLeastMotion = 0.5e-3;  // metres; of shorter steps noise decides the ratio

struct Scene {
  std::string name;
  Target target;
  std::vector<Intention> curves;
  double scale;
};

struct Way {
  const char* label;
  const TechniqueInfo* info;
  TechniqueOptions options;
};

struct Outcome {
  std::vector<double> step_ns;
  std::vector<double> distance_mm;  // D_ep of each stroke
  double worst_ratio = 0.0;
  std::array<long, 5> answers{};
};

double quantile(std::vector<double> values, double q) {
  if (values.empty()) return 0.0;
  const auto at = static_cast<std::ptrdiff_t>(q * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + at, values.end());
  return values[static_cast<std::size_t>(at)];
}

double mean(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double v : values) sum += v;
  return values.empty() ? 0.0 : sum / static_cast<double>(values.size());
}

void draw(const Scene& scene, const Way& way, const Stroke& stroke, Outcome& outcome) {
  const Similarity& place = stroke.model_to_world;
  const Canvas canvas{scene.target, place.scale};
  std::vector<Frame> frames;
  for (const Frame& f : stroke.frames) frames.push_back(to_model(f, place));
  std::vector<double> least(frames.size(), kInfinity);
  std::vector<Vec3> drawn, intended;
  for (int pass = 0; pass < kPasses; ++pass) {
    TechniqueMemory memory = way.info->first_memory;
    const Block& options = way.options.block(*way.info);
    std::optional<Vec3> last_point;
    Vec3 last_pen = Vec3::Zero();
    const bool first_pass = pass == 0;
    for (std::size_t i = 0; i < frames.size(); ++i) {
      const auto start = Clock::now();
      const TechniqueStep step = way.info->step(canvas, frames[i], options.data(), memory.data());
      const double ns = std::chrono::duration<double, std::nano>(Clock::now() - start).count();
      if (last_point) least[i] = std::min(least[i], ns);
      if (first_pass && step.answer != Answer::miss) {
        ++outcome.answers[static_cast<std::size_t>(step.answer)];
        drawn.push_back(place.point(step.position));
        const double dp = place.scale * (frames[i].controller.position - last_pen).norm();
        if (last_point && dp >= kLeastMotion)
          outcome.worst_ratio = std::max(outcome.worst_ratio,
                                         place.scale * (step.position - *last_point).norm() / dp);
      }
      if (step.answer != Answer::miss) {
        last_point = step.position;
        last_pen = frames[i].controller.position;
      }
    }
  }
  for (const double ns : least)
    if (ns < kInfinity) outcome.step_ns.push_back(ns);
  for (const SurfacePoint& p : stroke.intended->points)
    intended.push_back(place.point(scene.target.position(p)));
  outcome.distance_mm.push_back(1e3 * mean_corresponding_distance(drawn, intended));
}

Stroke closed_loop(const Scene& scene, const Way& way, const Intention& curve,
                   const Similarity& place, std::uint64_t seed) {
  const Canvas canvas{scene.target, place.scale};
  TechniqueMemory memory = way.info->first_memory;
  return simulate_closed_loop(
      scene.target, curve, place, {}, seed, [&](const Frame& world) -> std::optional<Vec3> {
        const auto step = way.info->step(canvas, to_model(world, place),
                                         way.options.block(*way.info).data(), memory.data());
        if (step.answer == Answer::miss) return std::nullopt;
        return place.point(step.position);
      });
}

enum class Hand { translated, automatic, closed_loop };

Scene builtin(std::string_view name, int resolution) {
  Target target(make_shape(name, {.resolution = resolution}));
  auto curves = intended_curves(name, target);
  return {std::string(name), std::move(target), std::move(curves),
          find_shape(name)->metres_per_unit};
}

std::vector<Scene> scenes() {
  std::vector<Scene> all;
  all.push_back(builtin("torus", kLargeTorusResolution));
  for (const char* name : {"sphere", "rounded-cube", "cube", "trefoil", "hand", "plate"})
    all.push_back(builtin(name, 0));
  try {
    const std::string folder = MIMICRY_STUDY_DATA "/";
    const auto set = read_targets(read_file(folder + "targets.json"), "targets.json");
    for (const TargetShape& shape : set.shapes) {
      const std::string file = folder + shape.name + ".obj";
      Target target(read_mesh(read_file(file), MeshFormat::obj, file));
      std::vector<Intention> curves;
      for (const TargetCurve& c : shape.curves) curves.push_back({"", false, c.points});
      all.push_back({"study " + shape.name, std::move(target), std::move(curves), shape.scale});
    }
  } catch (const std::exception& e) {
    std::fprintf(stderr, "without the study's shapes: %s\n", e.what());
  }
  return all;
}

}  // namespace

int main(int argc, char** argv) {
  const int seeds = argc > 1 ? std::atoi(argv[1]) : 2;
  const auto& live = find_technique("mimicry-live");
  TechniqueOptions soft;
  const double on = 1.0;
  set_option(live, soft, "soft-anchor", {&on, 1});
  const std::array<Way, 3> ways = {Way{"anchored-closest", &find_technique("anchored-closest"), {}},
                                   Way{"mimicry-live", &live, {}},
                                   Way{"mimicry-live soft", &live, soft}};
  const std::vector<Scene> all = scenes();
  const std::array<std::pair<Hand, const char*>, 3> hands = {
      std::pair{Hand::translated, "translated"}, std::pair{Hand::automatic, "automatic"},
      std::pair{Hand::closed_loop, "closed loop"}};
  for (const auto& [hand, hand_name] : hands) {
    std::printf("\n%s, %d seeds\n%-18s %6s %-18s %9s %9s %9s %9s %9s %9s %9s\n", hand_name, seeds,
                "shape", "faces", "technique", "median us", "p99 us", "D_ep mm", "its 50 %",
                "|dq|/|dp|", "smooth %", "section %");
    std::array<Outcome, 3> total;
    for (const Scene& scene : all) {
      std::array<Outcome, 3> outcomes;
      for (const Intention& curve : scene.curves)
        for (int i = 1; i <= seeds; ++i) {
          const auto seed = static_cast<std::uint64_t>(i);
          const Similarity place{Quat::Identity(), Vec3(0, 1.2, 0), scene.scale};
          SimulationOptions options;
          if (hand == Hand::translated) {
            options.copy = HandCopy::translated;
            options.smoothing_m = options.drift_m = options.wobble_rad = 0.0;
            options.turn_tremor_rad = options.turn_noise_rad = 0.0;
          }
          const auto open = simulate(scene.target, curve, place, options, seed);
          for (std::size_t w = 0; w < ways.size(); ++w)
            draw(scene, ways[w],
                 hand == Hand::closed_loop ? closed_loop(scene, ways[w], curve, place, seed) : open,
                 outcomes[w]);
        }
      for (std::size_t w = 0; w < ways.size(); ++w) {
        const Outcome& o = outcomes[w];
        const double found = std::max(1.0, static_cast<double>(o.step_ns.size()));
        std::printf("%-18s %6d %-18s %9.2f %9.2f %9.2f %9.2f %9.2f %9.2f %9.2f\n",
                    scene.name.c_str(), scene.target.mesh().face_count(), ways[w].label,
                    1e-3 * quantile(o.step_ns, 0.5), 1e-3 * quantile(o.step_ns, 0.99),
                    mean(o.distance_mm), quantile(o.distance_mm, 0.5), o.worst_ratio,
                    100.0 * static_cast<double>(o.answers[3]) / found,
                    100.0 * static_cast<double>(o.answers[4]) / found);
        total[w].distance_mm.insert(total[w].distance_mm.end(), o.distance_mm.begin(),
                                    o.distance_mm.end());
        total[w].worst_ratio = std::max(total[w].worst_ratio, o.worst_ratio);
      }
    }
    for (std::size_t w = 0; w < ways.size(); ++w)
      std::printf("all %d strokes: %-18s D_ep mean %.2f, median %.2f mm, largest |dq|/|dp| %.2f\n",
                  static_cast<int>(total[w].distance_mm.size()), ways[w].label,
                  mean(total[w].distance_mm), quantile(total[w].distance_mm, 0.5),
                  total[w].worst_ratio);
  }
  return 0;
}
