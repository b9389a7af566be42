// Delaunay tetrahedra beside Qhull's on the same points, and whole bakes.
// Peak memory: run one benchmark alone under /usr/bin/time -v.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <random>
#include <vector>

#include <benchmark/benchmark.h>

extern "C" {
#include <libqhull_r/qhull_ra.h>
}

#include <mimicry/bake/bake.h>
#include <mimicry/mesh/shapes.h>

#include "bake/delaunay.h"

namespace mimicry {
namespace {

std::vector<GridPoint> random_points(std::int64_t count) {
  std::mt19937 random(1);
  std::uniform_int_distribution<std::int32_t> coordinate(0, (1 << kGridBits) - 1);
  std::vector<GridPoint> points(static_cast<std::size_t>(count));
  for (GridPoint& p : points) p = {coordinate(random), coordinate(random), coordinate(random)};
  return points;
}

// Either sense of rotation; below 1e-3 of the cube of the longest edge counts as flat.
double flat_percent(const std::vector<Tet>& tets, const std::vector<GridPoint>& points) {
  const auto at = [&points](Index v) {
    const GridPoint& p = points[static_cast<std::size_t>(v)];
    return Vec3(p[0], p[1], p[2]);
  };
  std::size_t flat = 0;
  for (const Tet& t : tets) {
    const Vec3 a = at(t[0]), b = at(t[1]), c = at(t[2]), d = at(t[3]);
    const double longest = std::max({(b - a).norm(), (c - a).norm(), (d - a).norm(), (c - b).norm(),
                                     (d - b).norm(), (d - c).norm()});
    if (std::abs((b - a).cross(c - a).dot(d - a)) < 6e-3 * longest * longest * longest) ++flat;
  }
  return 100.0 * static_cast<double>(flat) / static_cast<double>(tets.size());
}

void count(benchmark::State& state, const std::vector<Tet>& tets,
           const std::vector<GridPoint>& points) {
  state.counters["points_per_s"] = benchmark::Counter(
      static_cast<double>(points.size()), benchmark::Counter::kIsIterationInvariantRate);
  state.counters["tets"] = static_cast<double>(tets.size());
  state.counters["flat_percent"] = flat_percent(tets, points);
}

void delaunay(benchmark::State& state) {
  const std::vector<GridPoint> points = random_points(state.range(0));
  std::vector<Tet> tets;
  for (auto _ : state) {
    Delaunay d;
    d.insert(points);
    tets = d.tets();
  }
  count(state, tets, points);
}

void qhull(benchmark::State& state) {
  const std::vector<GridPoint> points = random_points(state.range(0));
  std::vector<Tet> tets;
  for (auto _ : state) {
    std::vector<double> coordinates;
    for (const GridPoint& p : points) coordinates.insert(coordinates.end(), p.begin(), p.end());
    qhT context;
    qhT* qh = &context;
    qh_zero(qh, stderr);
    char options[] = "qhull d Qbb Qt Qc";
    qh_new_qhull(qh, 3, static_cast<int>(points.size()), coordinates.data(), False, options,
                 nullptr, stderr);
    tets.clear();
    for (facetT* facet = qh->facet_list; facet && facet->next; facet = facet->next) {
      if (facet->upperdelaunay) continue;
      Tet t{};
      for (std::size_t k = 0; k < 4; ++k)
        t[k] = qh_pointid(qh, static_cast<vertexT*>(facet->vertices->e[k].p)->point);
      tets.push_back(t);
    }
    qh_freeqhull(qh, qh_ALL);
  }
  count(state, tets, points);
}

void whole(benchmark::State& state, const char* shape, int resolution, int threads) {
  const TriangleMesh mesh = make_shape(shape, {.resolution = resolution});
  Embedding e;
  for (auto _ : state) e = bake(mesh, {}, threads);
  state.counters["faces"] = mesh.face_count();
  state.counters["tets"] = static_cast<double>(e.tets.size());
  state.counters["mds_iterations"] = e.quality.mds_iterations;
  state.counters["ls_mesh_iterations"] = e.quality.ls_mesh_iterations;
  state.counters["sliver_percent"] = e.quality.sliver_percent;
}

}  // namespace
}  // namespace mimicry

int main(int argc, char** argv) {
  using namespace mimicry;
  benchmark::Initialize(&argc, argv);
  for (const std::int64_t points : {32000, 259000}) {
    benchmark::RegisterBenchmark("delaunay", delaunay)
        ->Arg(points)
        ->Unit(benchmark::kMillisecond)
        ->Iterations(1);
    benchmark::RegisterBenchmark("qhull", qhull)
        ->Arg(points)
        ->Unit(benchmark::kMillisecond)
        ->Iterations(1);
  }
  const struct {
    const char* name;
    const char* shape;
    int resolution;
  } kBakes[] = {{"bake/cube-1K", "cube", 9},
                {"bake/hand-19K", "hand", 0},
                {"bake/torus-86K", "torus", mimicry::kLargeTorusResolution}};
  for (const auto& b : kBakes)
    for (const int threads : {1, 2})
      benchmark::RegisterBenchmark(
          b.name,
          [&b, threads](benchmark::State& state) { whole(state, b.shape, b.resolution, threads); })
          ->Unit(benchmark::kMillisecond)
          ->UseRealTime()
          ->MeasureProcessCPUTime()
          ->Iterations(1);
  benchmark::RunSpecifiedBenchmarks();
}
