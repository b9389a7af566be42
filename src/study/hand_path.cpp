#include "study/hand_path.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>

#include "base/finite.h"
#include "study/simulation_check.h"

namespace mimicry {
namespace {

// Gaussian along a closed path, or one that goes on beyond its ends: as the point reflection there
// (positions: the ends stay), or as the end value (directions).
enum class Ends { closed, reflected, constant };

std::vector<Vec3> smoothed(const std::vector<Vec3>& x, double sigma_steps, Ends ends) {
  const int n = static_cast<int>(x.size());
  const int reach = static_cast<int>(std::ceil(4 * std::min(sigma_steps, 0.25 * n)));
  if (reach < 1 || sigma_steps < 0.1) return x;
  std::vector<double> weights;
  double sum = 0;
  for (int k = -reach; k <= reach; ++k) {
    weights.push_back(std::exp(-0.5 * (k / sigma_steps) * (k / sigma_steps)));
    sum += weights.back();
  }
  const auto value = [&](int i) -> Vec3 {
    const int last = n - 1;  // of a closed path the same as the first
    if (i >= 0 && i <= last) return x[at(i)];
    if (ends == Ends::closed) return x[at(((i % last) + last) % last)];
    const Vec3& end = i < 0 ? x.front() : x.back();
    if (ends == Ends::constant) return end;
    return 2 * end - x[at(std::clamp(i < 0 ? -i : 2 * last - i, 0, last))];
  };
  std::vector<Vec3> y(x.size());
  for (int i = 0; i < n; ++i) {
    Vec3 total = Vec3::Zero();
    for (int k = -reach; k <= reach; ++k) total += weights[at(k + reach)] * value(i + k);
    y[at(i)] = total / sum;
  }
  return y;
}

// The direction, turned by as little as brings it within an angle of another one.
Vec3 turned_within(const Vec3& direction, const Vec3& other, double most_rad) {
  const double angle = std::atan2(direction.cross(other).norm(), direction.dot(other));
  if (angle <= most_rad) return direction;
  const Vec3 axis = unit_or(direction.cross(other), Vec3::UnitY());
  return (Eigen::AngleAxisd(angle - most_rad, axis) * direction).normalized();
}

// The normals of what surrounds the path, also around an edge: who aims looks at more than the
// point.
std::vector<Vec3> surrounding_normals(const Target& target, const Similarity& place,
                                      const Path& path) {
  constexpr double kAround_m = 0.015;
  constexpr int kDirections = 8;
  const int every = std::max(1, static_cast<int>(0.005 / path.step));
  const int last = static_cast<int>(path.points.size()) - 1;
  std::vector<Vec3> sparse;
  Index hint = kNone;
  for (int i = 0; i < last + every; i += every) {
    const Vec3& x = path.points[at(std::min(i, last))];
    const Vec3 n = unit_or(path.normals[at(std::min(i, last))], Vec3::UnitY());
    const Vec3 u = n.unitOrthogonal(), v = n.cross(u);
    Vec3 sum = n;
    for (int k = 0; k < kDirections; ++k) {
      const double angle = kTau * k / kDirections;
      // A little below the surface: beyond an edge the other side is closest.
      const Vec3 y = x + kAround_m * (std::cos(angle) * u + std::sin(angle) * v - 0.5 * n);
      const auto closest = target.closest_point(place.inverse_point(y), kInfinity, hint);
      if (!closest) continue;
      hint = closest->surface.face;
      // Not the other side of something thin.
      const Vec3 other = place.direction(target.normal(closest->surface));
      if (other.dot(n) > -0.3) sum += other;
    }
    sparse.push_back(unit_or(sum, n));
  }
  std::vector<Vec3> normals;
  for (int i = 0; i <= last; ++i) {
    const auto k = at(i / every);
    const double t = static_cast<double>(i % every) / every;
    normals.push_back(t > 0 ? Vec3(sparse[k] + t * (sparse[k + 1] - sparse[k])) : sparse[k]);
  }
  return normals;
}

}  // namespace

Path resampled(const Target& target, const Intention& intended, const Similarity& place) {
  std::vector<SurfacePoint> surface = intended.points;
  for (const SurfacePoint& p : surface)
    if (p.face < 0 || p.face >= target.mesh().face_count())
      refuse_simulation("curve " + intended.name + ": face " + std::to_string(p.face) +
                        " is not in the target's " + std::to_string(target.mesh().face_count()) +
                        "; pass the mesh that the curve was made on");
  if (intended.closed && !surface.empty()) surface.push_back(surface.front());
  std::vector<Vec3> points, normals;
  std::vector<double> lengths;
  for (const SurfacePoint& p : surface) {
    const Vec3 x = place.point(target.position(p));
    if (!is_finite(x)) refuse_simulation("curve " + intended.name + ": a point is not finite");
    if (!points.empty() && x == points.back()) continue;
    lengths.push_back(points.empty() ? 0.0 : lengths.back() + (x - points.back()).norm());
    points.push_back(x);
    normals.push_back(place.direction(target.normal(p)));
  }
  if (points.size() < 2 || !(lengths.back() > 1e-6))
    refuse_simulation("curve " + intended.name + " has fewer than two distinct points");

  constexpr double kStep = 0.5e-3;
  const int steps = static_cast<int>(std::clamp(lengths.back() / kStep, 200.0, 8000.0));
  Path path;
  path.closed = intended.closed;
  path.step = lengths.back() / steps;
  std::size_t i = 1;
  for (int k = 0; k <= steps; ++k) {
    const double s = lengths.back() * k / steps;
    while (i + 1 < points.size() && lengths[i] < s) ++i;
    const double t = (s - lengths[i - 1]) / (lengths[i] - lengths[i - 1]);
    path.points.push_back(points[i - 1] + t * (points[i] - points[i - 1]));
    path.normals.push_back(normals[i - 1] + t * (normals[i] - normals[i - 1]));
  }
  return path;
}

HandPath hand_path(const Path& path, const Target& target, const Similarity& place,
                   const SimulationOptions& options) {
  const Vec3 viewer = options.viewer.normalized();
  Vec3 mean = Vec3::Zero();
  for (const Vec3& n : path.normals) mean += n;
  mean = unit_or(mean / static_cast<double>(path.normals.size()), viewer);
  bool is_offset = options.copy == HandCopy::offset || options.copy == HandCopy::turned;
  if (options.copy == HandCopy::automatic)
    is_offset = std::any_of(path.normals.begin(), path.normals.end(),
                            [&mean](const Vec3& n) { return n.dot(mean) < 0; });
  const double sigma = options.smoothing_m / path.step;
  HandPath hand;
  hand.base = smoothed(path.points, sigma, path.closed ? Ends::closed : Ends::reflected);
  if (options.wrist_part > 0) {
    Vec3 centre = Vec3::Zero();
    for (const Vec3& x : hand.base) centre += x / static_cast<double>(hand.base.size());
    for (Vec3& x : hand.base) x += options.wrist_part * (centre - x);
  }
  if (options.copy == HandCopy::placed)
    mean = turned_within(mean, unit_or(path.normals.front(), mean), options.slant_rad);
  if (!is_offset) {
    hand.away.assign(path.points.size(), mean);
    return hand;
  }
  // Normals first turn smoothly, then the path that they lead to is smoothed like the base.
  constexpr double kTurn_m = 0.02;
  constexpr double kWrist_m = 0.04;  // who turns no more than needed does it in good time
  const Ends ends = path.closed ? Ends::closed : Ends::constant;
  const bool is_turned = options.copy == HandCopy::turned;
  hand.away = smoothed(is_turned ? surrounding_normals(target, place, path) : path.normals,
                       kTurn_m / path.step, ends);
  if (is_turned) {
    Vec3 direction = mean;
    for (Vec3& n : hand.away) n = direction = turned_within(direction, n, options.slant_rad);
    hand.away = smoothed(hand.away, kWrist_m / path.step, ends);
  }
  Vec3 previous = mean;
  for (Vec3& n : hand.away) previous = n = unit_or(n, previous);
  hand.away = smoothed(hand.away, sigma, ends);
  return hand;
}

std::vector<double> progress(const std::vector<Vec3>& hand, int frames, double step,
                             const SimulationOptions& options) {
  const int n = static_cast<int>(hand.size());
  const int reach = std::max(1, static_cast<int>(std::lround(0.003 / step)));
  std::vector<double> way(hand.size(), 0.0);
  for (std::size_t i = 1; i < hand.size(); ++i)
    way[i] = way[i - 1] + (hand[i] - hand[i - 1]).norm();
  const double start = std::max(1e-9, std::min(options.start_m, 0.1 * way.back()));
  std::vector<double> time(hand.size(), 0.0);
  double previous = 0;
  for (int i = 0; i < n; ++i) {
    const int middle =
        std::clamp(i, std::min(reach, (n - 1) / 2), n - 1 - std::min(reach, (n - 1) / 2));
    const Vec3 before = hand[at(middle)] - hand[at(std::max(0, middle - reach))];
    const Vec3 after = hand[at(std::min(n - 1, middle + reach))] - hand[at(middle)];
    const double angle = std::atan2(before.cross(after).norm(), before.dot(after));
    const double chord = 0.5 * (before.norm() + after.norm());
    const double curvature = chord > 0 ? angle / chord : 0;
    const double to_end = std::min(way[at(i)], way.back() - way[at(i)]);
    const double ramp = std::sqrt(std::min(1.0, (to_end + 0.01 * start) / start));
    const double speed =
        ramp * std::pow(curvature + options.least_curvature, -options.speed_exponent);
    if (i > 0)
      time[at(i)] = time[at(i - 1)] + (way[at(i)] - way[at(i - 1)]) * 2 / (speed + previous);
    previous = speed;
  }
  std::vector<double> result;
  std::size_t i = 1;
  for (int f = 0; f < frames; ++f) {
    const double t = time.back() * f / (frames - 1);
    while (i + 1 < time.size() && time[i] < t) ++i;
    const double gap = time[i] - time[i - 1];
    result.push_back(static_cast<double>(i - 1) + (gap > 0 ? (t - time[i - 1]) / gap : 0.0));
  }
  return result;
}

Vec3 sample(const std::vector<Vec3>& x, double i) {
  const auto low = std::min(static_cast<std::size_t>(i), x.size() - 2);
  return x[low] + (i - static_cast<double>(low)) * (x[low + 1] - x[low]);
}

}  // namespace mimicry
