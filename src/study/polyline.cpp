#include "study/polyline.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace mimicry {

double polyline_length(std::span<const Vec3> points) {
  double sum = 0.0;
  for (std::size_t i = 1; i < points.size(); ++i) sum += (points[i] - points[i - 1]).norm();
  return sum;
}

std::vector<Vec3> resample(std::span<const Vec3> points, int count) {
  assert(count >= 2);
  std::vector<Vec3> even;
  if (points.empty()) return even;
  even.reserve(static_cast<std::size_t>(count));
  const double length = polyline_length(points);
  double passed = 0.0;  // length up to points[segment]
  std::size_t segment = 0;
  for (int i = 0; i + 1 < count; ++i) {
    const double wanted = length * i / (count - 1);
    while (segment + 1 < points.size()) {
      const double step = (points[segment + 1] - points[segment]).norm();
      if (passed + step >= wanted && step > 0.0) {
        even.push_back(points[segment] +
                       (wanted - passed) / step * (points[segment + 1] - points[segment]));
        break;
      }
      passed += step;
      ++segment;
    }
    if (segment + 1 >= points.size()) even.push_back(points.back());
  }
  even.push_back(points.back());
  return even;
}

double mean_corresponding_distance(std::span<const Vec3> drawn, std::span<const Vec3> intended) {
  if (drawn.empty() || intended.empty()) return std::numeric_limits<double>::quiet_NaN();
  return mean_distance(resample(drawn, kComparedPoints), resample(intended, kComparedPoints));
}

double mean_distance(std::span<const Vec3> drawn, std::span<const Vec3> intended) {
  assert(drawn.size() == intended.size() && !drawn.empty());
  double sum = 0.0;
  for (std::size_t i = 0; i < drawn.size(); ++i) sum += (drawn[i] - intended[i]).norm();
  return sum / static_cast<double>(drawn.size());
}

double distance_spread(std::span<const Vec3> drawn, std::span<const Vec3> intended) {
  assert(drawn.size() == intended.size() && !drawn.empty());
  double least = std::numeric_limits<double>::infinity();
  double most = 0.0;
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    const double distance = (drawn[i] - intended[i]).norm();
    least = std::min(least, distance);
    most = std::max(most, distance);
  }
  return most - least;
}

double symmetric_distance(std::span<const Vec3> drawn, std::span<const Vec3> intended) {
  assert(!drawn.empty() && !intended.empty());
  std::vector<double> nearest(intended.size(), std::numeric_limits<double>::infinity());
  double to_intended = 0.0;
  for (const Vec3& q : drawn) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < intended.size(); ++i) {
      const double squared = (q - intended[i]).squaredNorm();
      least = std::min(least, squared);
      nearest[i] = std::min(nearest[i], squared);
    }
    to_intended += std::sqrt(least);
  }
  double to_drawn = 0.0;
  for (const double squared : nearest) to_drawn += std::sqrt(squared);
  return 0.5 * (to_intended / static_cast<double>(drawn.size()) +
                to_drawn / static_cast<double>(intended.size()));
}

double frechet_distance(std::span<const Vec3> drawn, std::span<const Vec3> intended) {
  assert(!drawn.empty() && !intended.empty());
  // leash[j], squared: to have come to drawn[i] and intended[j].
  std::vector<double> leash(intended.size());
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    double diagonal = 0.0;  // leash[j - 1] of the row before
    for (std::size_t j = 0; j < intended.size(); ++j) {
      const double above = leash[j];
      double way = 0.0;
      if (i > 0 && j > 0)
        way = std::min({above, diagonal, leash[j - 1]});
      else if (i > 0)
        way = above;
      else if (j > 0)
        way = leash[j - 1];
      leash[j] = std::max(way, (drawn[i] - intended[j]).squaredNorm());
      diagonal = above;
    }
  }
  return std::sqrt(leash.back());
}

std::size_t inversions(std::span<const Vec3> drawn, std::span<const Vec3> keypoints) {
  std::vector<std::size_t> closest;
  closest.reserve(keypoints.size());
  for (const Vec3& keypoint : keypoints) {
    std::size_t best = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < drawn.size(); ++i) {
      const double squared = (drawn[i] - keypoint).squaredNorm();
      if (squared < least) best = i, least = squared;
    }
    closest.push_back(best);
  }
  std::size_t count = 0;
  for (std::size_t a = 0; a < closest.size(); ++a)
    for (std::size_t b = a + 1; b < closest.size(); ++b) count += closest[a] > closest[b] ? 1 : 0;
  return count;
}

}  // namespace mimicry
