#include <cassert>
#include <limits>

#include <mimicry/study/polyline.h>

namespace mimicry::study {

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
  const std::vector<Vec3> q = resample(drawn, kComparedPoints);
  const std::vector<Vec3> x = resample(intended, kComparedPoints);
  double sum = 0.0;
  for (std::size_t i = 0; i < q.size(); ++i) sum += (q[i] - x[i]).norm();
  return sum / kComparedPoints;
}

}  // namespace mimicry::study
