#include "geodesic/fast_marching.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace mimicry {
namespace {

// Labels that improve by less than this are left alone.
constexpr double kImprovement = 1.0 - 1e-5;

// Distance of (x, y), y >= 0, from the virtual source below the edge from (0, 0) to (length, 0)
// whose ends have the distances d0 and d1; kInfinity where the straight way does not cross the
// edge.
inline double unfold(double d0, double d1, double length, double x, double y) {
  const double source_x = 0.5 * ((d0 - d1) * (d0 + d1) / length + length);
  const double height_squared = d0 * d0 - source_x * source_x;
  const double height = height_squared > 0.0 ? std::sqrt(height_squared) : 0.0;
  const double rise = y + height;
  const double crossing = source_x * y + x * height;
  if (crossing < 0.0 || crossing > length * rise) return kInfinity;
  const double run = x - source_x;
  return std::sqrt(run * run + rise * rise);
}

}  // namespace

FastMarching::FastMarching(const TriangleMesh& mesh) {
  const auto vertices = static_cast<std::size_t>(mesh.vertex_count());
  first_.assign(vertices + 1, 0);
  for (const Face& f : mesh.faces())
    for (const Index v : f) ++first_[static_cast<std::size_t>(v) + 1];
  for (std::size_t v = 0; v < vertices; ++v) first_[v + 1] += first_[v];
  corners_.resize(static_cast<std::size_t>(first_[vertices]));

  const double size = diagonal(mesh);
  unit_ = size > 0.0 ? size : 1.0;
  double longest = 0.0, sum = 0.0;
  std::vector<Index> fill(first_.begin(), first_.end() - 1);
  for (Index f = 0; f < mesh.face_count(); ++f) {
    for (int k = 0; k < 3; ++k) {
      const auto at = [&](int corner) { return static_cast<std::size_t>((k + corner) % 3); };
      Corner& c =
          corners_[static_cast<std::size_t>(fill[static_cast<std::size_t>(mesh.face(f)[at(0)])]++)];
      c.a = mesh.face(f)[at(1)];
      c.b = mesh.face(f)[at(2)];
      const Vec3 a = (mesh.position(c.a) - mesh.corner(f, k)) / unit_;
      const Vec3 b = (mesh.position(c.b) - mesh.corner(f, k)) / unit_;
      const double length_a = a.norm(), length_b = b.norm();
      const double dot = a.dot(b), cross = a.cross(b).norm();
      c.length_a = static_cast<float>(length_a);
      c.length_b = static_cast<float>(length_b);
      c.b_x = static_cast<float>(length_a > 0.0 ? dot / length_a : 0.0);
      c.b_y = static_cast<float>(length_a > 0.0 ? cross / length_a : 0.0);
      c.a_x = static_cast<float>(length_b > 0.0 ? dot / length_b : 0.0);
      c.a_y = static_cast<float>(length_b > 0.0 ? cross / length_b : 0.0);
      c.blunt_a = a.dot(a - b) < 0.0;
      c.blunt_b = b.dot(b - a) < 0.0;
      longest = std::max(longest, length_a);
      sum += length_a;
    }
  }
  // A front narrower than an edge keeps corrections rare; the ring of buckets holds the longest
  // edge.
  constexpr double kBucketsPerEdge = 4.0;
  constexpr double kMostBuckets = 4000.0;
  if (!corners_.empty() && longest > 0.0) {
    const double mean = sum / static_cast<double>(corners_.size());
    bucket_width_ = std::max(mean / kBucketsPerEdge, longest / kMostBuckets);
    bucket_count_ = static_cast<std::size_t>(longest / bucket_width_) + 3;
  }
}

void FastMarching::march(Index source, Scratch& scratch) const {
  auto& labels = scratch.labels_;
  auto& buckets = scratch.buckets_;
  if (buckets.size() < bucket_count_) buckets.resize(bucket_count_);
  scratch.touched_.clear();
  const double per_width = 1.0 / bucket_width_;
  std::size_t current = 0;  // number of the bucket under way, not yet folded onto the ring
  std::size_t waiting = 1;

  const auto propose = [&](Index v, double distance) {
    Scratch::Label& label = labels[static_cast<std::size_t>(v)];
    if (!(distance < label.distance * kImprovement)) return;
    label.distance = distance;
    const auto bucket = std::max(current, static_cast<std::size_t>(distance * per_width));
    buckets[bucket % bucket_count_].push_back(v);
    ++waiting;
  };

  labels[static_cast<std::size_t>(source)].distance = 0.0;
  buckets[0].push_back(source);
  for (; waiting > 0; ++current) {
    std::vector<Index>& bucket = buckets[current % bucket_count_];
    for (std::size_t k = 0; k < bucket.size(); ++k) {
      const Index v = bucket[k];
      --waiting;
      Scratch::Label& label = labels[static_cast<std::size_t>(v)];
      const double d = label.distance;
      if (label.spread == d) continue;
      if (label.spread < 0.0) scratch.touched_.push_back(v);
      label.spread = d;
      const auto end = static_cast<std::size_t>(first_[static_cast<std::size_t>(v) + 1]);
      for (auto i = static_cast<std::size_t>(first_[static_cast<std::size_t>(v)]); i < end; ++i) {
        const Corner& c = corners_[i];
        const Scratch::Label a = labels[static_cast<std::size_t>(c.a)];
        const Scratch::Label b = labels[static_cast<std::size_t>(c.b)];
        const double length_a = static_cast<double>(c.length_a);
        const double length_b = static_cast<double>(c.length_b);
        // An edge counts as a base once the front has passed both its ends. A corner that the front
        // has passed before can only be reached by a shorter way through an obtuse angle.
        double to_a = d + length_a;
        double to_b = d + length_b;
        if (b.spread >= 0.0 && (a.distance > d || c.blunt_a) && length_b > 0.0)
          to_a = std::min(to_a, unfold(d, b.distance, length_b, static_cast<double>(c.a_x),
                                       static_cast<double>(c.a_y)));
        if (a.spread >= 0.0 && (b.distance > d || c.blunt_b) && length_a > 0.0)
          to_b = std::min(to_b, unfold(d, a.distance, length_a, static_cast<double>(c.b_x),
                                       static_cast<double>(c.b_y)));
        propose(c.a, to_a);
        propose(c.b, to_b);
      }
    }
    bucket.clear();
  }
}

void FastMarching::distances(Index source, std::span<double> distances, Scratch& scratch) const {
  assert(static_cast<Index>(distances.size()) == vertex_count());
  assert(source >= 0 && source < vertex_count());
  scratch.labels_.assign(distances.size(), {kInfinity, -1.0});
  march(source, scratch);
  for (std::size_t v = 0; v < distances.size(); ++v)
    distances[v] = scratch.labels_[v].distance * unit_;
}

void FastMarching::lower(Index source, std::span<double> nearest, Scratch& scratch) const {
  assert(static_cast<Index>(nearest.size()) == vertex_count());
  assert(source >= 0 && source < vertex_count());
  auto& labels = scratch.labels_;
  labels.resize(nearest.size());
  for (std::size_t v = 0; v < nearest.size(); ++v) labels[v] = {nearest[v] / unit_, -1.0};
  march(source, scratch);
  for (const Index v : scratch.touched_)
    nearest[static_cast<std::size_t>(v)] = labels[static_cast<std::size_t>(v)].distance * unit_;
}

}  // namespace mimicry
