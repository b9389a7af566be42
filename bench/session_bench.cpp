// One frame of a session with its curve piece: medians and the slowest per cent.
#include <algorithm>
#include <chrono>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include <mimicry/io/targets_reader.h>
#include <mimicry/mesh/shapes.h>
#include <mimicry/session/stroke_session.h>
#include <mimicry/study/intended_curves.h>
#include <mimicry/study/simulate.h>

#include "study_mesh.h"

namespace mimicry {
namespace {

struct Drawing {
  spatial::Target target;
  std::vector<stroke::Stroke> strokes;
};

Drawing draw_on(spatial::Target target, const std::vector<stroke::Intention>& curves,
                double scale) {
  Drawing drawing{std::move(target), {}};
  Similarity placed;
  placed.scale = scale;
  std::uint64_t seed = 1;
  for (const auto& curve : curves)
    drawing.strokes.push_back(study::simulate(drawing.target, curve, placed, {}, seed++));
  return drawing;
}

Drawing torus() {
  spatial::Target target(make_shape("torus", {.resolution = kLargeTorusResolution}));
  const auto curves = study::intended_curves("torus", target);
  return draw_on(std::move(target), curves, find_shape("torus")->metres_per_unit);
}

Drawing draw_on_bunny(const TriangleMesh& mesh) {
  const study::TargetSet set =
      io::read_targets(files::read_file(MIMICRY_STUDY_DATA "/targets.json"), "targets.json");
  const study::TargetShape& shape = *set.find("bunny");
  std::vector<stroke::Intention> curves;
  for (const auto& curve : shape.curves) curves.push_back({"", false, curve.points});
  return draw_on(spatial::Target(mesh), curves, shape.scale);
}

void add_frame(benchmark::State& state, const Drawing& drawing, const std::string& technique) {
  using Clock = std::chrono::steady_clock;
  session::StrokeSession session({&drawing.target}, technique::find_technique(technique));
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
  if (const auto bunny = bench::study_mesh("bunny"))
    drawings.emplace_back("bunny", draw_on_bunny(*bunny));
  for (const auto& [name, drawing] : drawings)
    for (const auto& info : technique::techniques())
      if (!info.needs_bake)
        benchmark::RegisterBenchmark(
            ("add_frame/" + name + "/" + std::string(info.name)).c_str(),
            [&drawing = drawing, technique = std::string(info.name)](benchmark::State& state) {
              add_frame(state, drawing, technique);
            })
            ->Unit(benchmark::kMillisecond)
            ->MinTime(1.0);
  benchmark::RunSpecifiedBenchmarks();
}
