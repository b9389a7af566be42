// All measures of one stroke of 400 frames on the hand.
#include <string>

#include <benchmark/benchmark.h>

#include <mimicry/mesh/shapes.h>
#include <mimicry/session/stroke_session.h>
#include <mimicry/study/measures.h>
#include <mimicry/study/simulate.h>
#include <mimicry/study/targets.h>

namespace mimicry {
namespace {

void add_measure(benchmark::State& state, const std::string& technique) {
  const Target target(make_shape("hand"));
  const Intention meant = intended_curves("hand", target)[1];
  Similarity placed;
  placed.scale = find_shape("hand")->metres_per_unit;
  SimulationOptions options;
  options.least_duration_s = options.most_duration_s = 400.0 / 90.0;
  const Stroke stroke = simulate(target, meant, placed, options, 1);
  const ProjectedCurve curve = project({target}, find_technique(technique), stroke).curve;
  TargetCurve wanted{meant.points, {}, {}};
  wanted.keypoints = keypoints(target.surface(), wanted.points, placed.scale);
  const IntendedCurve intended = intended_curve(target.mesh(), wanted, placed.scale);
  for (auto _ : state)
    benchmark::DoNotOptimize(measure(target.surface(), intended, curve, motion_of(stroke)));
  state.counters["frames"] = static_cast<double>(stroke.frames.size());
}

BENCHMARK_CAPTURE(add_measure, spraycan, "spraycan")->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(add_measure, mimicry_live, "mimicry-live")->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace mimicry

BENCHMARK_MAIN();
