// One frame of a session with its curve piece: medians and the slowest per cent.
#include <algorithm>
#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include <mimicry/bake/bake.h>
#include <mimicry/io/study.h>
#include <mimicry/mesh/shapes.h>
#include <mimicry/session/stroke_session.h>
#include <mimicry/study/simulate.h>
#include <mimicry/study/targets.h>

#include "study_mesh.h"

namespace mimicry {
namespace {

struct Drawing {
  Target target;
  SmoothProjector projector;
  std::vector<Stroke> strokes;
};

// For techniques that need one; the target stays where it is.
void bake_for(Drawing& drawing) {
  drawing.projector = SmoothProjector(mimicry::bake(drawing.target.mesh(), {}, 2), drawing.target);
}

Drawing draw_on(Target target, const std::vector<Intention>& curves, double scale) {
  Drawing drawing{std::move(target), {}, {}};
  Similarity placed;
  placed.scale = scale;
  std::uint64_t seed = 1;
  for (const auto& curve : curves)
    drawing.strokes.push_back(simulate(drawing.target, curve, placed, {}, seed++));
  return drawing;
}

Drawing torus() {
  Target target(make_shape("torus", {.resolution = kLargeTorusResolution}));
  const auto curves = intended_curves("torus", target);
  return draw_on(std::move(target), curves, find_shape("torus")->metres_per_unit);
}

Drawing draw_on_study(const TriangleMesh& mesh, const std::string& name) {
  const TargetSet set = read_targets(read_file(MIMICRY_STUDY_DATA "/targets.json"), "targets.json");
  const TargetShape& shape = *set.find(name);
  std::vector<Intention> curves;
  for (const auto& curve : shape.curves) curves.push_back({"", false, curve.points});
  return draw_on(Target(mesh), curves, shape.scale);
}

void add_frame(benchmark::State& state, const Drawing& drawing, const std::string& technique) {
  using Clock = std::chrono::steady_clock;
  StrokeSession session({drawing.target, 1.0, drawing.projector}, find_technique(technique));
  std::vector<double> micros;
  for (auto _ : state) {
    for (const auto& stroke : drawing.strokes) {
      session.begin(stroke.model_to_world);
      for (const auto& frame : stroke.frames) {
        const auto start = Clock::now();
        benchmark::DoNotOptimize(session.add(frame));
        micros.push_back(std::chrono::duration<double, std::micro>(Clock::now() - start).count());
      }
    }
  }
  std::sort(micros.begin(), micros.end());
  const auto quantile = [&](double q) {
    return micros[static_cast<std::size_t>(q * static_cast<double>(micros.size() - 1))];
  };
  state.counters["median_us"] = quantile(0.5);
  state.counters["p99_us"] = quantile(0.99);
  state.counters["largest_us"] = micros.back();
  state.counters["frames"] = static_cast<double>(micros.size());
}

}  // namespace
}  // namespace mimicry

int main(int argc, char** argv) {
  using namespace mimicry;
  benchmark::Initialize(&argc, argv);
  std::vector<std::pair<std::string, Drawing>> drawings;
  drawings.emplace_back("torus86K", torus());
  for (const std::string name : {"bunny", "trebol"})
    if (const auto mesh = bench::study_mesh(name))
      drawings.emplace_back(name, draw_on_study(*mesh, name));
  for (auto& [name, drawing] : drawings)
    for (const auto& info : techniques())
      benchmark::RegisterBenchmark(("add_frame/" + name + "/" + std::string(info.name)).c_str(),
                                   [&drawing = drawing, &info](benchmark::State& state) {
                                     if (info.needs_bake && !drawing.projector) bake_for(drawing);
                                     add_frame(state, drawing, std::string(info.name));
                                   })
          ->Unit(benchmark::kMillisecond)
          ->MinTime(1.0);
  benchmark::RunSpecifiedBenchmarks();
}
