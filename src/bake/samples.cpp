#include "bake/samples.h"

#include <algorithm>

namespace mimicry {

std::vector<Index> farthest_points(const TriangleMesh& mesh, const FastMarching& distances,
                                   Index count, const ProgressCallback& progress) {
  // Vertices without faces are nearest to something already.
  std::vector<double> nearest(static_cast<std::size_t>(mesh.vertex_count()), 0.0);
  for (const Face& f : mesh.faces())
    for (const Index v : f) nearest[static_cast<std::size_t>(v)] = kInfinity;

  std::vector<Index> samples;
  if (mesh.face_count() == 0) return samples;
  const Vec3 centre = bounding_box(mesh).center();
  Index next = kNone;
  double farthest = -1.0;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    const double d = (mesh.position(v) - centre).squaredNorm();
    if (nearest[static_cast<std::size_t>(v)] > 0.0 && d > farthest) {
      farthest = d;
      next = v;
    }
  }
  FastMarching::Scratch scratch;
  while (static_cast<Index>(samples.size()) < count) {
    samples.push_back(next);
    distances.lower(next, nearest, scratch);
    const auto top = std::max_element(nearest.begin(), nearest.end());
    if (!(*top > 0.0)) break;
    next = static_cast<Index>(top - nearest.begin());
    if (samples.size() % 64 == 0)
      report(progress, "samples", static_cast<double>(samples.size()) / count);
  }
  return samples;
}

Eigen::MatrixXd sample_distances(const TriangleMesh& mesh, const FastMarching& distances,
                                 std::span<const Index> samples, Executor& executor,
                                 const ProgressCallback& progress) {
  const auto n = static_cast<Eigen::Index>(samples.size());
  Eigen::MatrixXd d(n, n);
  struct Worker {
    std::vector<double> from;
    FastMarching::Scratch scratch;
  };
  std::vector<Worker> workers(static_cast<std::size_t>(executor.threads()));
  // Reported between blocks, from this thread.
  const std::size_t block = 32 * workers.size();
  for (std::size_t first = 0; first < samples.size(); first += block) {
    report(progress, "distances", static_cast<double>(first) / static_cast<double>(samples.size()));
    executor.for_chunks(
        std::min(block, samples.size() - first), 1,
        [&](std::size_t begin, std::size_t, int number) {
          Worker& worker = workers[static_cast<std::size_t>(number)];
          worker.from.resize(static_cast<std::size_t>(mesh.vertex_count()));
          const auto i = static_cast<Eigen::Index>(first + begin);
          distances.distances(samples[first + begin], worker.from, worker.scratch);
          for (Eigen::Index j = 0; j < n; ++j)
            d(j, i) = worker.from[static_cast<std::size_t>(samples[static_cast<std::size_t>(j)])];
        });
  }
  for (Eigen::Index i = 0; i < n; ++i) {
    d(i, i) = 0.0;
    for (Eigen::Index j = 0; j < i; ++j) {
      const double over = 0.5 * (d(i, j) + d(j, i));
      const Vec3& a = mesh.position(samples[static_cast<std::size_t>(i)]);
      const Vec3& b = mesh.position(samples[static_cast<std::size_t>(j)]);
      d(i, j) = d(j, i) = over < kInfinity ? over : (a - b).norm();
    }
  }
  return d;
}

}  // namespace mimicry
