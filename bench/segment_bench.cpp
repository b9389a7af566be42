// Cuts of the 86K-face torus: one almost closed curve of 500 points, and 100 random ones.

#include <cmath>
#include <vector>

#include <benchmark/benchmark.h>

#include <mimicry/base/random.h>
#include <mimicry/geodesic/paths.h>
#include <mimicry/mesh/shapes.h>
#include <mimicry/segment/segment.h>

#include "curve/curve_builder.h"

namespace {

using namespace mimicry;

const Surface& torus() {
  static const Surface surface{make_shape("torus", {.resolution = kLargeTorusResolution})};
  return surface;
}

CurvePoint point_at(const SurfacePoint& p) {
  CurvePoint point;
  point.surface = p;
  point.position = torus().position(p);
  point.normal = torus().normal(p);
  return point;
}

// Straight walks that turn a little at each point.
ProjectedCurve wandering(Random& random, int points, double step, double turn) {
  CurveBuilder builder(torus());
  SurfacePoint p{
      static_cast<Index>(random.below(static_cast<std::uint32_t>(torus().mesh().face_count()))),
      Vec3(0.3, 0.3, 0.4)};
  Vec3 direction(random.normal(), random.normal(), random.normal());
  for (int i = 0; i < points; ++i) {
    builder.append(point_at(p));
    const Trace trace = trace_straightest(torus(), p, direction, step);
    p = trace.end;
    const Vec3 aside = torus().normal(p).cross(trace.direction);
    direction = trace.direction + turn * (turn > 0.02 ? random.normal() : 1.0) * aside;
  }
  return builder.curve();
}

void cut(benchmark::State& state, const std::vector<ProjectedCurve>& curves) {
  Segmentation result;
  for (auto _ : state) {
    result = segment(torus(), curves);
    benchmark::DoNotOptimize(result.labels.data());
  }
  state.counters["faces"] = static_cast<double>(result.surface.mesh().face_count());
  state.counters["parts"] = static_cast<double>(result.parts.size());
  state.counters["crossings"] = static_cast<double>(result.crossings);
}

void BM_AlmostClosedCurve(benchmark::State& state) {
  Random random(1);
  // 495 steps of a circle of 500.
  cut(state, {wandering(random, 495, 0.004, kTau / 500)});
}
BENCHMARK(BM_AlmostClosedCurve)->Unit(benchmark::kMillisecond);

void BM_HundredCurves(benchmark::State& state) {
  Random random(1);
  std::vector<ProjectedCurve> curves;
  for (int i = 0; i < 100; ++i) curves.push_back(wandering(random, 30, 0.05, 0.05));
  cut(state, curves);
}
BENCHMARK(BM_HundredCurves)->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
