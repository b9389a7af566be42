// Painting, frame by frame, beside the exponential map alone: the time of each frame of a stroke
// (median and 99th percentile), texels and faces touched; and the making of atlases.

#include <algorithm>
#include <ctime>
#include <optional>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include <mimicry/base/random.h>
#include <mimicry/geodesic/exponential_map.h>
#include <mimicry/geodesic/paths.h>
#include <mimicry/mesh/shapes.h>
#include <mimicry/paint/brush.h>

#include "study_mesh.h"

namespace {

using namespace mimicry;

constexpr int kTexture = 4096;
constexpr int kFrames = 600;
constexpr double kStep = 0.004;  // of the diagonal, a frame: 0.2 m/s at 90 Hz on 0.6 m

/// Faces of very different sizes, as of scanned figures: a sphere with a knobbly surface, whose
/// vertices crowd at one side.
TriangleMesh uneven_mesh() {
  TriangleMesh sphere = make_sphere(66);  // 87,120 faces
  std::vector<Vec3> positions(sphere.positions().begin(), sphere.positions().end());
  for (Vec3& x : positions) {
    x = (x + Vec3(0.0, 0.0, 0.6)).normalized();
    x *= 1.0 + 0.08 * std::sin(9.0 * x.x()) * std::sin(11.0 * x.y()) * std::cos(7.0 * x.z());
  }
  return sphere.with_positions(positions);
}

std::optional<Surface> surface_of(int which) {
  if (which == 0) {
    ShapeOptions options;
    options.resolution = kLargeTorusResolution;
    return Surface(make_shape("torus", options));
  }
  if (which == 1) return Surface(uneven_mesh());
  const auto bunny = bench::study_mesh("bunny");
  if (!bunny) return std::nullopt;
  return Surface(*bunny);
}

struct Step {
  SurfacePoint to;
  std::vector<Crossing> crossings;
};

std::vector<Step> stroke_on(const Surface& surface) {
  Random random(7);
  std::vector<Step> steps;
  SurfacePoint last{surface.mesh().face_count() / 3, Vec3::Constant(1.0 / 3.0)};
  Vec3 direction(0.6, 0.5, 0.3);
  const double length = kStep * diagonal(surface.mesh());
  while (steps.size() < kFrames) {
    Step step;
    const Trace trace = trace_straightest(surface, last, direction, length, &step.crossings);
    step.to = trace.end;
    steps.push_back(step);
    last = trace.end;
    direction = trace.direction + 0.2 * Vec3(random.normal(), random.normal(), random.normal());
  }
  return steps;
}

void report(benchmark::State& state, std::vector<double>& times) {
  std::sort(times.begin(), times.end());
  state.counters["median_ms"] = times[times.size() / 2];
  state.counters["p99_ms"] = times[times.size() * 99 / 100];
}

// Processor time: of a machine with other work.
template <class Frame>
double time_ms(Frame&& frame) {
  const std::clock_t start = std::clock();
  frame();
  return 1e3 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

// range(0): the mesh; range(1): the radius in thousandths of the diagonal.
void PaintFrame(benchmark::State& state, BrushBlend blend) {
  const auto surface = surface_of(static_cast<int>(state.range(0)));
  if (!surface) return state.SkipWithError("no study data");
  const PaintAtlas atlas = PaintAtlas::cells(*surface, kTexture);
  PaintLayers layers(kTexture, {255, 255, 255});
  StrokePainter painter(atlas);
  Brush brush;
  brush.radius = 1e-3 * static_cast<double>(state.range(1)) * diagonal(surface->mesh());
  brush.blend = blend;
  const std::vector<Step> steps = stroke_on(*surface);
  std::vector<double> times;
  for (auto _ : state) {
    painter.begin(layers, 0, brush);
    painter.move_to(steps.front().to);
    for (std::size_t i = 1; i < steps.size(); ++i)
      times.push_back(time_ms([&] { painter.line_to(steps[i].crossings, steps[i].to); }));
    painter.end();
    while (layers.undo()) {
    }
  }
  report(state, times);
  state.counters["megabytes"] =
      static_cast<double>(layers.memory_bytes() + atlas.memory_bytes() + painter.memory_bytes()) /
      1e6;
  state.counters["bytes_a_face"] =
      static_cast<double>(atlas.memory_bytes() + painter.memory_bytes()) /
      static_cast<double>(surface->mesh().face_count());
}

void MapAlone(benchmark::State& state) {
  const auto surface = surface_of(static_cast<int>(state.range(0)));
  if (!surface) return state.SkipWithError("no study data");
  DiscreteExponentialMap map(*surface);
  const double radius = 1e-3 * static_cast<double>(state.range(1)) * diagonal(surface->mesh());
  const std::vector<Step> steps = stroke_on(*surface);
  std::vector<double> times;
  std::size_t vertices = 0;
  for (auto _ : state)
    for (const Step& step : steps)
      times.push_back(time_ms([&] { vertices += map.compute(step.to, radius).vertices.size(); }));
  report(state, times);
  state.counters["vertices"] = static_cast<double>(vertices) / static_cast<double>(times.size());
}

void Cells(benchmark::State& state) {
  const auto surface = surface_of(static_cast<int>(state.range(0)));
  if (!surface) return state.SkipWithError("no study data");
  double share = 0.0;
  for (auto _ : state) {
    const PaintAtlas atlas = PaintAtlas::cells(*surface, kTexture);
    share = static_cast<double>(atlas.used_texels()) / static_cast<double>(atlas.texel_count());
  }
  state.counters["faces"] = static_cast<double>(surface->mesh().face_count());
  state.counters["used"] = share;
}

void meshes_and_radii(benchmark::internal::Benchmark* b) {
  b->ArgNames({"mesh", "permille"})->ArgsProduct({{0, 1, 2}, {10, 30, 50}});
  b->Unit(benchmark::kMillisecond)->Iterations(1);
}

BENCHMARK(MapAlone)->Apply(meshes_and_radii);
BENCHMARK_CAPTURE(PaintFrame, build, BrushBlend::build)->Apply(meshes_and_radii);
BENCHMARK_CAPTURE(PaintFrame, max, BrushBlend::max)->Apply(meshes_and_radii);
BENCHMARK(Cells)->ArgName("mesh")->DenseRange(0, 2)->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
