// All measures of one stroke of 400 frames on the hand.
#include <string>

#include <benchmark/benchmark.h>

#include <mimicry/mesh/shapes.h>
#include <mimicry/session/stroke_session.h>
#include <mimicry/study/intended_curves.h>
#include <mimicry/study/keypoints.h>
#include <mimicry/study/measures.h>
#include <mimicry/study/simulate.h>

namespace mimicry {
namespace {

void add_measure(benchmark::State& state, const std::string& technique) {
  const spatial::Target target(make_shape("hand"));
  const stroke::Intention meant = study::intended_curves("hand", target)[1];
  Similarity placed;
  placed.scale = find_shape("hand")->metres_per_unit;
  study::SimulationOptions options;
  options.least_duration_s = options.most_duration_s = 400.0 / 90.0;
  const stroke::Stroke stroke = study::simulate(target, meant, placed, options, 1);
  const curve::ProjectedCurve curve =
      session::project({&target}, technique::find_technique(technique), stroke);
  study::TargetCurve wanted{meant.points, {}, {}};
  wanted.keypoints =
      study::keypoints(target.mesh(), target.half_edges(), wanted.points, placed.scale);
  const study::IntendedCurve intended = study::intended_curve(target.mesh(), wanted, placed.scale);
  for (auto _ : state)
    benchmark::DoNotOptimize(study::measure(target.mesh(), target.half_edges(), intended, curve,
                                            study::motion_of(stroke)));
  state.counters["frames"] = static_cast<double>(stroke.frames.size());
}

BENCHMARK_CAPTURE(add_measure, spraycan, "spraycan")->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(add_measure, mimicry_live, "mimicry-live")->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace mimicry

BENCHMARK_MAIN();
