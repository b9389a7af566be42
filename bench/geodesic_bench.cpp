#include <algorithm>
#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include <mimicry/base/random.h>
#include <mimicry/geodesic/exact.h>
#include <mimicry/geodesic/exponential_map.h>
#include <mimicry/geodesic/paths.h>
#include <mimicry/mesh/shapes.h>
#include <mimicry/mesh/surface.h>

#include "geodesic/site.h"
#include "study_mesh.h"

namespace {

using namespace mimicry;
using namespace mimicry;

std::optional<TriangleMesh> bunny() {
  return bench::study_mesh("bunny");
}

// Each face cut into four, without smoothing: the same surface, so the same distances.
TriangleMesh refined(const TriangleMesh& mesh) {
  const Surface surface = Surface::as_given(mesh);
  const HalfEdges& edges = surface.half_edges();
  std::vector<Vec3> positions(mesh.positions().begin(), mesh.positions().end());
  std::vector<Index> middles(static_cast<std::size_t>(edges.count()), kNone);
  const auto middle = [&](Index h) {
    Index& m = middles[static_cast<std::size_t>(edges.edge(h))];
    if (m == kNone) {
      m = static_cast<Index>(positions.size());
      positions.push_back(position(mesh, Crossing{h, 0.5}));
    }
    return m;
  };
  std::vector<Face> faces;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const Face& c = mesh.face(f);
    const Index m[3] = {middle(3 * f), middle(3 * f + 1), middle(3 * f + 2)};
    faces.push_back({c[0], m[0], m[2]});
    faces.push_back({m[0], c[1], m[1]});
    faces.push_back({m[2], m[1], c[2]});
    faces.push_back({m[0], m[1], m[2]});
  }
  return {positions, faces};
}

SurfacePoint random_point(const TriangleMesh& mesh, Random& random, Index face) {
  (void)mesh;
  double a = random.uniform();
  double b = random.uniform();
  if (a + b > 1.0) a = 1.0 - a, b = 1.0 - b;
  return {face, Vec3(1.0 - a - b, a, b)};
}

void one_to_all(benchmark::State& state, const TriangleMesh& mesh) {
  const Surface surface = Surface::as_given(mesh);
  const HalfEdges& edges = surface.half_edges();
  ExactGeodesics geodesics(surface);
  Random random(1);
  for (auto _ : state) {
    const auto v =
        static_cast<Index>(random.below(static_cast<std::uint32_t>(mesh.vertex_count())));
    geodesics.compute(vertex_point(edges, v));
  }
  state.counters["faces"] = static_cast<double>(mesh.face_count());
  state.counters["windows"] = static_cast<double>(geodesics.windows_made());
  state.counters["megabytes"] = static_cast<double>(geodesics.memory_bytes()) / 1e6;
}

void ExactBunny(benchmark::State& state) {
  if (const auto mesh = bunny())
    one_to_all(state, *mesh);
  else
    state.SkipWithError("no study data");
}
BENCHMARK(ExactBunny)->Unit(benchmark::kMillisecond)->Repetitions(5)->ReportAggregatesOnly();

void ExactBunnyEachFaceInFour(benchmark::State& state) {
  if (const auto mesh = bunny())
    one_to_all(state, refined(*mesh));
  else
    state.SkipWithError("no study data");
}
BENCHMARK(ExactBunnyEachFaceInFour)->Unit(benchmark::kMillisecond);

void ExactTorus86K(benchmark::State& state) {
  ShapeOptions options;
  options.resolution = kLargeTorusResolution;
  one_to_all(state, make_shape("torus", options));
}
BENCHMARK(ExactTorus86K)->Unit(benchmark::kMillisecond);

// Pairs of points about state.range(0) tenths of a millimetre apart, on a bunny 60 cm large.
void LocalPathBunny(benchmark::State& state) {
  const auto mesh = bunny();
  if (!mesh) {
    state.SkipWithError("no study data");
    return;
  }
  const Surface surface = Surface::as_given(*mesh);
  const double apart = static_cast<double>(state.range(0)) * 1e-4 / 0.6 * diagonal(*mesh);
  Random random(2);
  std::vector<std::pair<SurfacePoint, SurfacePoint>> pairs;
  while (pairs.size() < 4096) {
    const auto face =
        static_cast<Index>(random.below(static_cast<std::uint32_t>(mesh->face_count())));
    const SurfacePoint a = random_point(*mesh, random, face);
    const Vec3 direction(random.normal(), random.normal(), random.normal());
    const Trace trace = trace_straightest(surface, a, direction, apart);
    if (trace.stop == TraceStop::complete) pairs.emplace_back(a, trace.end);
  }
  LocalPathFinder finder(surface);
  std::vector<Crossing> crossings;
  std::size_t i = 0;
  std::size_t proven = 0;
  for (auto _ : state) {
    const auto& [a, b] = pairs[i++ % pairs.size()];
    crossings.clear();
    const LocalPath path = finder.find(a, b, crossings);
    proven += path.label != PathLabel::locally_shortest;
    benchmark::DoNotOptimize(path.length);
  }
  state.counters["proven"] = static_cast<double>(proven) / static_cast<double>(i);

  std::vector<double> each;
  for (const auto& [a, b] : pairs) {
    crossings.clear();
    const auto start = std::chrono::steady_clock::now();
    finder.find(a, b, crossings);
    const std::chrono::duration<double, std::nano> taken = std::chrono::steady_clock::now() - start;
    each.push_back(taken.count());
  }
  std::sort(each.begin(), each.end());
  state.counters["median_ns"] = each[each.size() / 2];
  state.counters["p99_ns"] = each[each.size() * 99 / 100];
}
BENCHMARK(LocalPathBunny)->Arg(30)->Arg(100)->Arg(300)->Arg(1000);

void ExponentialMapBunny(benchmark::State& state) {
  const auto mesh = bunny();
  if (!mesh) {
    state.SkipWithError("no study data");
    return;
  }
  const Surface surface = Surface::as_given(*mesh);
  DiscreteExponentialMap map(surface);
  Random random(3);
  std::size_t vertices = 0;
  for (auto _ : state) {
    const auto face =
        static_cast<Index>(random.below(static_cast<std::uint32_t>(mesh->face_count())));
    vertices +=
        map.compute(random_point(*mesh, random, face), 0.05 * diagonal(*mesh)).vertices.size();
  }
  state.counters["vertices"] =
      static_cast<double>(vertices) / static_cast<double>(state.iterations());
}
BENCHMARK(ExponentialMapBunny)->Unit(benchmark::kMicrosecond);

}  // namespace

BENCHMARK_MAIN();
