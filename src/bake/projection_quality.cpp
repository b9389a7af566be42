#include "bake/projection_quality.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <mimicry/base/random.h>

namespace mimicry {
namespace {

constexpr std::size_t kPointChunk = 16, kPointBlock = 16 * kPointChunk;
constexpr int kPointsPerTet = 4;
constexpr int kPointsPerFace = 9;  // corners, a point on each edge, three inside

// Uniform in the simplex.
template <int N>
Eigen::Matrix<double, N, 1> random_weights(Random& random) {
  Eigen::Matrix<double, N, 1> w;
  for (double& x : w) x = -std::log(1.0 - random.uniform());
  const double sum = w.sum();
  return sum > 0.0 ? (w / sum).eval() : Eigen::Matrix<double, N, 1>::Constant(1.0 / N).eval();
}

struct Counts {
  std::size_t queries = 0, beyond = 0, beyond_fails = 0;
  std::size_t fails = 0, no_solution = 0, outside = 0, misses = 0;
  double error = 0.0;

  void add(const Counts& other) {
    queries += other.queries;
    beyond += other.beyond;
    beyond_fails += other.beyond_fails;
    fails += other.fails;
    no_solution += other.no_solution;
    outside += other.outside;
    misses += other.misses;
    error = std::max(error, other.error);
  }
};

// A sum over the chunks of [0, count), in blocks between which the caller hears of it.
template <class Body>
Counts sum(std::size_t count, Executor& executor, const ProgressCallback& progress,
           std::string_view stage, Body&& body) {
  std::vector<Counts> parts(static_cast<std::size_t>(executor.threads()));
  for (std::size_t begin = 0; begin < count; begin += kPointBlock) {
    report(progress, stage, static_cast<double>(begin) / static_cast<double>(count));
    executor.for_chunks(std::min(kPointBlock, count - begin), kPointChunk,
                        [&](std::size_t first, std::size_t last, int worker) {
                          ScpHint hint;
                          Counts& counts = parts[static_cast<std::size_t>(worker)];
                          for (std::size_t i = first; i < last; ++i)
                            body(static_cast<Index>(begin + i), hint, counts);
                        });
  }
  Counts total;
  for (const Counts& part : parts) total.add(part);
  return total;
}

}  // namespace

ProjectionQuality projection_quality(const SmoothProjector& projector, Executor& executor,
                                     const ProgressCallback& progress) {
  const Embedding& e = projector.embedding();
  const Target& target = projector.target();
  const double diagonal = target.diagonal(), allowed = diagonal / 20.0,
               offset = e.options.offset * diagonal;

  const auto shell_point = [&](Index tet, ScpHint& hint, Counts& counts) {
    Random random(1, static_cast<std::uint64_t>(tet));
    for (int i = 0; i < kPointsPerTet; ++i) {
      const Eigen::Vector4d w = random_weights<4>(random);
      Vec3 p = Vec3::Zero();
      for (std::size_t k = 0; k < 4; ++k)
        p += w[static_cast<Eigen::Index>(k)] *
             e.positions[static_cast<std::size_t>(e.tets[static_cast<std::size_t>(tet)][k])];
      hint.tet = tet;
      const auto q = projector.project(p, {}, &hint);
      if (!q) continue;
      const double nearest = target.closest_point(p, kInfinity, hint.face)->distance;
      const bool fails = (p - q->position).norm() > nearest + allowed;
      if (nearest > offset) {
        ++counts.beyond;
        if (fails) ++counts.beyond_fails;
        continue;
      }
      ++counts.queries;
      if (fails) ++counts.fails;
      if (q->label == ScpLabel::no_phong_solution) ++counts.no_solution;
      if (q->label == ScpLabel::outside_shell) ++counts.outside;
    }
  };
  const auto surface_point = [&](Index face, ScpHint& hint, Counts& counts) {
    Random random(2, static_cast<std::uint64_t>(face));
    for (int i = 0; i < kPointsPerFace; ++i) {
      Vec3 bary = Vec3::Unit(i % 3);
      if (i >= 6) bary = random_weights<3>(random);
      if (i >= 3 && i < 6) {
        const double t = random.uniform();
        bary = (1.0 - t) * Vec3::Unit(i % 3) + t * Vec3::Unit((i + 1) % 3);
      }
      const Vec3 p = target.position({face, bary});
      hint.face = face;
      const auto q = projector.project(p, {}, &hint);
      if (!q) continue;
      const double error = (p - q->position).norm() / diagonal;
      counts.error = std::max(counts.error, error);
      if (error > 1e-9) ++counts.misses;
    }
  };

  ProjectionQuality quality;
  quality.surface_queries = kPointsPerFace * e.faces.size();
  const Counts shell = sum(e.tets.size(), executor, progress, "shell points", shell_point);
  const Counts surface = sum(e.faces.size(), executor, progress, "surface points", surface_point);
  const auto percent = [](std::size_t count, std::size_t of) {
    return of == 0 ? 0.0 : 100.0 * static_cast<double>(count) / static_cast<double>(of);
  };
  quality.queries = shell.queries;
  quality.beyond_queries = shell.beyond;
  quality.fail_percent = percent(shell.fails, shell.queries);
  quality.no_solution_percent = percent(shell.no_solution, shell.queries);
  quality.outside_percent = percent(shell.outside, shell.queries);
  quality.beyond_fail_percent = percent(shell.beyond_fails, shell.beyond);
  quality.surface_error = surface.error;
  quality.surface_misses = surface.misses;
  return quality;
}

}  // namespace mimicry
