// Distances from one vertex to all, by each of our ways and by the heat method: time to prepare,
// time a source, and the error against the exact distances.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include <mimicry/base/random.h>
#include <mimicry/geodesic/exact.h>
#include <mimicry/mesh/shapes.h>

#include "geodesic/fast_marching.h"
#include "geodesic/site.h"
#include "heat_method.h"
#include "study_mesh.h"

namespace {

using namespace mimicry;

struct Exact {
  explicit Exact(const TriangleMesh& mesh) : surface(Surface::as_given(mesh)), geodesics(surface) {}
  void distances(Index source, std::span<double> out) {
    geodesics.compute(vertex_point(surface.half_edges(), source));
    for (std::size_t v = 0; v < out.size(); ++v) out[v] = geodesics.distance(static_cast<Index>(v));
  }
  Surface surface;
  ExactGeodesics geodesics;
};

struct Marching {
  explicit Marching(const TriangleMesh& mesh) : march(mesh) {}
  void distances(Index source, std::span<double> out) { march.distances(source, out, scratch); }
  FastMarching march;
  FastMarching::Scratch scratch;
};

// Relative errors; next to the source, within 1 % of the diagonal, they are relative to that 1 %.
struct Errors {
  double mean = 0.0;
  double largest = 0.0;
};

template <class Method>
Errors errors(const TriangleMesh& mesh, Method& method, const std::vector<Index>& sources) {
  Exact exact(mesh);
  const auto n = static_cast<std::size_t>(mesh.vertex_count());
  std::vector<double> truth(n);
  std::vector<double> found(n);
  const double least = 0.01 * diagonal(mesh);
  Errors result;
  double count = 0.0;
  for (const Index source : sources) {
    exact.distances(source, truth);
    method.distances(source, found);
    for (std::size_t v = 0; v < n; ++v) {
      const double error = std::abs(found[v] - truth[v]) / std::max(truth[v], least);
      result.mean += error;
      result.largest = std::max(result.largest, error);
      count += 1.0;
    }
  }
  result.mean /= count;
  return result;
}

template <class Method>
void one_to_all(benchmark::State& state, const std::string& name) {
  TriangleMesh mesh;
  if (name == "torus 86K") {
    mesh = make_shape("torus", {.resolution = kLargeTorusResolution});
  } else if (name == "noisy cube 20 %") {
    mesh = make_noisy_cube(16, 0.2, true, 1);
  } else if (auto read = bench::study_mesh(name)) {
    mesh = std::move(*read);
  } else {
    state.SkipWithError("no study data");
    return;
  }
  Random random(1);
  std::vector<Index> sources;
  for (int i = 0; i < 10; ++i)
    sources.push_back(
        static_cast<Index>(random.below(static_cast<std::uint32_t>(mesh.vertex_count()))));

  const auto start = std::chrono::steady_clock::now();
  Method method(mesh);
  const std::chrono::duration<double, std::milli> prepared =
      std::chrono::steady_clock::now() - start;
  std::vector<double> found(static_cast<std::size_t>(mesh.vertex_count()));
  std::size_t i = 0;
  for (auto _ : state) method.distances(sources[i++ % sources.size()], found);

  const Errors e = errors(mesh, method, sources);
  state.counters["prepare_ms"] = prepared.count();
  state.counters["mean_percent"] = 100.0 * e.mean;
  state.counters["largest_percent"] = 100.0 * e.largest;
}

}  // namespace

int main(int argc, char** argv) {
  for (const std::string name : {"trebol", "bunny", "noisy cube 20 %", "torus 86K"}) {
    const auto add = [&](const std::string& method, auto* function) {
      benchmark::RegisterBenchmark((name + "/" + method).c_str(), [=](benchmark::State& state) {
        function(state, name);
      })->Unit(benchmark::kMillisecond);
    };
    add("exact", one_to_all<Exact>);
    add("fast marching", one_to_all<Marching>);
    add("heat method", one_to_all<bench::HeatMethod>);
  }
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
