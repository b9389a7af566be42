#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <mimicry/base/error.h>
#include <mimicry/base/finite.h>
#include <mimicry/base/random.h>
#include <mimicry/study/simulate.h>

namespace mimicry::study {
namespace {

constexpr double kTau = 2 * std::numbers::pi;

// One stream of random numbers for each cause, so that changing one leaves the others.
enum Stream : std::uint64_t {
  kDuration,
  kDrift,
  kTremor,
  kNoise,
  kWobble,
  kTurnTremor,
  kTurnNoise,
  kStart
};

std::size_t at(int i) {
  return static_cast<std::size_t>(i);
}

Vec3 unit_or(const Vec3& v, const Vec3& otherwise) {
  const double length = v.norm();
  return length > 1e-9 ? Vec3(v / length) : otherwise;
}

[[noreturn]] void fail(const std::string& what) {
  throw Error(ErrorKind::invalid_input, "simulate: " + what);
}

// False for NaN, which must not be compared: that trips the floating-point traps.
bool within(double value, double least, double most) {
  return std::isfinite(value) && value >= least && value <= most;
}

void check(const SimulationOptions& o) {
  if (!within(o.rate_hz, 20, 1000))
    fail("rate_hz " + std::to_string(o.rate_hz) + " is not within 20 to 1000");
  if (!within(o.least_duration_s, 0.1, 600) || !within(o.most_duration_s, o.least_duration_s, 600))
    fail("durations must be within 0.1 to 600 s, the least first");
  for (const auto& [value, name] : {std::pair{o.mean_distance_m, "mean_distance_m"},
                                    {o.smoothing_m, "smoothing_m"},
                                    {o.drift_m, "drift_m"},
                                    {o.tremor_m, "tremor_m"},
                                    {o.noise_m, "noise_m"},
                                    {o.wobble_rad, "wobble_rad"},
                                    {o.turn_tremor_rad, "turn_tremor_rad"},
                                    {o.turn_noise_rad, "turn_noise_rad"},
                                    {o.speed_exponent, "speed_exponent"},
                                    {o.start_m, "start_m"},
                                    {o.start_error_m, "start_error_m"},
                                    {o.aimed_start_s, "aimed_start_s"},
                                    {o.head_distance_m, "head_distance_m"},
                                    {o.facing_rad, "facing_rad"},
                                    {o.most_head_turn_rad_per_s, "most_head_turn_rad_per_s"},
                                    {o.feedback_delay_s, "feedback_delay_s"},
                                    {o.feedback_gain_per_s, "feedback_gain_per_s"},
                                    {o.most_correction_m_per_s, "most_correction_m_per_s"},
                                    {o.most_corrected_m, "most_corrected_m"},
                                    {o.slant_rad, "slant_rad"},
                                    {o.least_drift_hz, "least_drift_hz"},
                                    {o.most_drift_hz, "most_drift_hz"},
                                    {o.least_tremor_hz, "least_tremor_hz"},
                                    {o.most_tremor_hz, "most_tremor_hz"},
                                    {o.least_wobble_hz, "least_wobble_hz"},
                                    {o.most_wobble_hz, "most_wobble_hz"}})
    if (!within(value, 0, 1000)) fail(std::string(name) + " is not within 0 to 1000");
  if (!within(o.turned_correction, 0, 1)) fail("turned_correction is not within 0 to 1");
  if (!within(o.head_follow, 0, 1)) fail("head_follow is not within 0 to 1");
  if (!within(o.head_turn, 0, 1)) fail("head_turn is not within 0 to 1");
  if (!within(o.wrist_part, 0, 0.9)) fail("wrist_part is not within 0 to 0.9");
  if (!within(o.coordination, 0, 1)) fail("coordination is not within 0 to 1");
  if (!within(o.least_curvature, 1e-9, 1e9)) fail("least_curvature is not within 1e-9 to 1e9");
  if (!is_finite(o.viewer) || o.viewer.norm() < 1e-9) fail("viewer must be a direction");
}

// A random motion whose spectrum lies in a band: sinusoids of random frequency and phase.
class BandMotion {
 public:
  BandMotion(double rms, double least_hz, double most_hz, Random random) {
    constexpr int kWaves = 12;
    const double amplitude = rms * std::sqrt(2.0 / (3 * kWaves));
    for (int axis = 0; axis < 3; ++axis)
      for (int i = 0; i < kWaves; ++i) {
        // One wave in each part of the band: the sum varies less from seed to seed.
        const double part = (i + random.uniform()) / kWaves;
        waves_.push_back({axis, amplitude, kTau * (least_hz + part * (most_hz - least_hz)),
                          kTau * random.uniform()});
      }
  }
  Vec3 operator()(double t) const {
    Vec3 x = Vec3::Zero();
    for (const Wave& w : waves_) x[w.axis] += w.amplitude * std::sin(w.omega * t + w.phase);
    return x;
  }

 private:
  struct Wave {
    int axis;
    double amplitude, omega, phase;
  };
  std::vector<Wave> waves_;
};

Vec3 white(double rms, Random& random) {
  const double x = random.normal(), y = random.normal(), z = random.normal();
  return rms / std::sqrt(3.0) * Vec3(x, y, z);
}

// The intended curve at equal steps of its length, in the world.
struct Path {
  bool closed = false;
  double step = 0;  // metres
  std::vector<Vec3> points;
  std::vector<Vec3> normals;
};

Path resampled(const spatial::Target& target, const stroke::Intention& intended,
               const Similarity& place) {
  std::vector<SurfacePoint> surface = intended.points;
  for (const SurfacePoint& p : surface)
    if (p.face < 0 || p.face >= target.mesh().face_count())
      fail("curve " + intended.name + ": face " + std::to_string(p.face) +
           " is not in the target's " + std::to_string(target.mesh().face_count()) +
           "; pass the mesh that the curve was made on");
  if (intended.closed && !surface.empty()) surface.push_back(surface.front());
  std::vector<Vec3> points, normals;
  std::vector<double> lengths;
  for (const SurfacePoint& p : surface) {
    const Vec3 x = place.point(target.position(p));
    if (!is_finite(x)) fail("curve " + intended.name + ": a point is not finite");
    if (!points.empty() && x == points.back()) continue;
    lengths.push_back(points.empty() ? 0.0 : lengths.back() + (x - points.back()).norm());
    points.push_back(x);
    normals.push_back(place.direction(target.normal(p)));
  }
  if (points.size() < 2 || !(lengths.back() > 1e-6))
    fail("curve " + intended.name + " has fewer than two distinct points");

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

// Zero-phase low pass in time: an exponential filter there and back.
void low_pass(std::vector<Vec3>& x, double dt, double tau) {
  const double keep = std::exp(-dt / tau);
  for (std::size_t i = 1; i < x.size(); ++i) x[i] = keep * x[i - 1] + (1 - keep) * x[i];
  for (std::size_t i = x.size() - 1; i-- > 0;) x[i] = keep * x[i + 1] + (1 - keep) * x[i];
}

// The direction, turned by as little as brings it within an angle of another one.
Vec3 turned_within(const Vec3& direction, const Vec3& other, double most_rad) {
  const double angle = std::atan2(direction.cross(other).norm(), direction.dot(other));
  if (angle <= most_rad) return direction;
  const Vec3 axis = unit_or(direction.cross(other), Vec3::UnitY());
  return (Eigen::AngleAxisd(angle - most_rad, axis) * direction).normalized();
}

// The hand's path for any distance: base + distance * away.
struct HandPath {
  std::vector<Vec3> base;
  std::vector<Vec3> away;
};

// The normals of what surrounds the path, also around an edge: who aims looks at more than the
// point.
std::vector<Vec3> surrounding_normals(const spatial::Target& target, const Similarity& place,
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

HandPath hand_path(const Path& path, const spatial::Target& target, const Similarity& place,
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

// Where on the path (in steps) the hand is at each frame: two-thirds power law, from rest to rest.
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

// Rotation whose -z axis is `forward` and whose y axis is as near to `up` as possible.
Quat looking(const Vec3& forward, const Vec3& up) {
  Mat3 axes;
  const Vec3 right = forward.cross(up).normalized();
  axes << right, right.cross(forward), -forward;
  return Quat(axes).normalized();
}

// Upright as far as it goes: the up direction is carried along and drawn to the vertical within
// about a third of a second, so that looking straight down does not make the head spin.
class Gaze {
 public:
  explicit Gaze(double dt) : pull_(std::min(1.0, 3 * dt)) {}
  Quat operator()(const Vec3& forward) {
    Vec3 up = up_ + pull_ * Vec3::UnitY();
    if (forward.cross(up).norm() < 1e-6)
      up = std::abs(forward.x()) < 0.5 ? Vec3::UnitX() : Vec3::UnitZ();
    const Quat q = looking(forward, up);
    up_ = q * Vec3::UnitY();
    return q;
  }

 private:
  double pull_;
  Vec3 up_ = Vec3::UnitY();
};

// Shortest turn from one direction to another, applied to q.
Quat carried(const Quat& q, const Vec3& from, const Vec3& to) {
  const Vec3 axis = from.cross(to);
  const double w = 1 + from.dot(to);
  if (w < 1e-6) return looking(to, q * Vec3::UnitY());
  return (Quat(w, axis.x(), axis.y(), axis.z()).normalized() * q).normalized();
}

Quat small_turn(const Vec3& rotation) {
  const double angle = rotation.norm();
  return angle > 0 ? Quat(Eigen::AngleAxisd(angle, rotation / angle)) : Quat::Identity();
}

std::vector<Vec3> head_positions(const std::vector<Vec3>& tips, const std::vector<Vec3>& normals,
                                 double dt, const SimulationOptions& options) {
  // The direction from the tip to the head: kept while the surface faces it, else turned after it.
  std::vector<Vec3> directions;
  Vec3 direction = options.viewer.normalized();
  for (const Vec3& n : normals) {
    const double angle = std::atan2(direction.cross(n).norm(), direction.dot(n));
    if (angle > options.facing_rad) {
      const Vec3 axis = unit_or(direction.cross(n), Vec3::UnitY());
      const double turn =
          std::min(angle - options.facing_rad, options.most_head_turn_rad_per_s * dt);
      direction = (Eigen::AngleAxisd(turn, axis) * direction).normalized();
    }
    directions.push_back(direction);
  }
  low_pass(directions, dt, 0.3);
  // The body follows a part of the hand's way, slowly.
  std::vector<Vec3> centres = tips;
  low_pass(centres, dt, 0.5);
  Vec3 mean = Vec3::Zero();
  for (const Vec3& x : tips) mean += x;
  mean /= static_cast<double>(tips.size());
  std::vector<Vec3> heads;
  for (std::size_t i = 0; i < tips.size(); ++i)
    heads.push_back(mean + options.head_follow * (centres[i] - mean) +
                    options.head_distance_m * unit_or(directions[i], options.viewer.normalized()));
  return heads;
}

// What the person plans, and the disturbances, frame by frame.
struct Plan {
  std::vector<Vec3> intended;
  std::vector<Vec3> tips;  // without disturbances
  std::vector<Vec3> normals;
};

stroke::Stroke draw(const spatial::Target& target, const stroke::Intention& intended,
                    const Similarity& place, const SimulationOptions& options, std::uint64_t seed,
                    const InkFunction* ink) {
  check(options);
  if (!std::isfinite(place.scale) || place.scale <= 0 || !is_finite(place.translation) ||
      !is_finite(place.rotation))
    fail("the target's place must be finite and its scale positive");
  const Path path = resampled(target, intended, place);
  const HandPath hand = hand_path(path, target, place, options);

  Random duration_random(seed, kDuration);
  const double duration =
      duration_random.uniform(options.least_duration_s, options.most_duration_s);
  const int frames = std::max(2, static_cast<int>(std::lround(duration * options.rate_hz)) + 1);
  const double dt = 1 / options.rate_hz;

  const BandMotion drift(options.drift_m, options.least_drift_hz, options.most_drift_hz,
                         Random(seed, kDrift));
  const BandMotion tremor(options.tremor_m, options.least_tremor_hz, options.most_tremor_hz,
                          Random(seed, kTremor));
  Random noise_random(seed, kNoise);
  // The start is aimed at before the trigger is pulled: slow errors begin at zero.
  const auto settled = [&options](double t) {
    return options.aimed_start_s > 0 ? 1 - std::exp(-t / options.aimed_start_s) : 1.0;
  };
  Random start_random(seed, kStart);
  const Vec3 start_error = white(options.start_error_m, start_random);
  std::vector<Vec3> disturbance;
  for (int f = 0; f < frames; ++f)
    disturbance.push_back(start_error + settled(f * dt) * drift(f * dt) + tremor(f * dt) +
                          white(options.noise_m, noise_random));

  std::vector<Vec3> hand_points(hand.base.size());
  const auto plan_at = [&](double distance) {
    for (std::size_t i = 0; i < hand_points.size(); ++i)
      hand_points[i] = hand.base[i] + distance * hand.away[i];
    Plan plan;
    for (const double i : progress(hand_points, frames, path.step, options)) {
      plan.tips.push_back(sample(hand_points, i));
      plan.intended.push_back(sample(path.points, i));
      plan.normals.push_back(sample(path.normals, i));
    }
    return plan;
  };
  const auto mean_distance = [&](const Plan& plan) {
    double sum = 0;
    Index hint = kNone;
    for (std::size_t f = 0; f < plan.tips.size(); ++f) {
      const auto closest =
          target.closest_point(place.inverse_point(plan.tips[f] + disturbance[f]), kInfinity, hint);
      if (!closest) continue;
      hint = closest->surface.face;
      sum += closest->distance * place.scale;
    }
    return sum / static_cast<double>(plan.tips.size());
  };

  // False position (Illinois) for the copy's distance: the mean closest distance need not grow
  // everywhere, but it is continuous and grows in the end.
  Plan plan = plan_at(0);
  double low = 0, low_excess = mean_distance(plan) - options.mean_distance_m;
  if (low_excess < 0) {
    double high = options.mean_distance_m, high_excess = -1;
    for (int i = 0; i < 40; ++i) {
      plan = plan_at(high);
      high_excess = mean_distance(plan) - options.mean_distance_m;
      if (high_excess >= 0) break;
      low = high;
      low_excess = high_excess;
      high *= 1.5;
    }
    double excess = high_excess;
    for (int i = 0; i < 30 && std::abs(excess) > 1e-3 * options.mean_distance_m; ++i) {
      const double middle = low + (high - low) * low_excess / (low_excess - high_excess);
      plan = plan_at(middle);
      const double before = std::exchange(excess, mean_distance(plan) - options.mean_distance_m);
      const bool same_side = (excess < 0) == (before < 0);
      if (excess < 0) {
        low = middle;
        low_excess = excess;
        if (same_side) high_excess /= 2;
      } else {
        high = middle;
        high_excess = excess;
        if (same_side) low_excess /= 2;
      }
    }
  }

  const BandMotion wobble(options.wobble_rad * std::sqrt(1.5), options.least_wobble_hz,
                          options.most_wobble_hz, Random(seed, kWobble));
  const BandMotion turn_tremor(options.turn_tremor_rad, options.least_tremor_hz,
                               options.most_tremor_hz, Random(seed, kTurnTremor));
  Random turn_noise_random(seed, kTurnNoise);
  const std::vector<Vec3> heads = head_positions(plan.tips, plan.normals, dt, options);

  Vec3 middle = Vec3::Zero();
  for (const Vec3& tip : plan.tips) middle += tip / static_cast<double>(frames);
  const auto looked_at = [&](std::size_t i) -> Vec3 {
    if (options.head_turn == 1) return plan.tips[i];
    return middle + options.head_turn * (plan.tips[i] - middle);
  };

  stroke::Stroke stroke;
  stroke.id = intended.name;
  stroke.model_to_world = place;
  stroke.intended = intended;
  stroke.frames.reserve(at(frames));
  Gaze gaze(dt);
  Quat aim = Quat::Identity();
  Vec3 aim_direction = Vec3::Zero();
  Vec3 correction = Vec3::Zero();  // of the hand's place, and of the point that it aims at
  Vec3 aim_correction = Vec3::Zero();
  std::vector<Vec3> errors;
  const auto delay = static_cast<std::size_t>(std::lround(options.feedback_delay_s / dt));
  for (int f = 0; f < frames; ++f) {
    const std::size_t i = at(f);
    const double t = f * dt;
    if (ink != nullptr && i >= delay && !errors.empty()) {
      Vec3 seen = errors[std::min(i - delay, errors.size() - 1)];
      if (seen.norm() > options.most_corrected_m) {
        // Ink on another part of the shape: how far behind or before it is does not matter.
        const Vec3 sight = unit_or(plan.intended[i] - heads[i], -options.viewer.normalized());
        seen -= seen.dot(sight) * sight;
        seen *= std::min(1.0, options.most_corrected_m / std::max(seen.norm(), 1e-9));
      }
      const double speed = options.feedback_gain_per_s * seen.norm();
      const double allowed = std::min(speed, options.most_correction_m_per_s);
      if (speed > 0) {
        const Vec3 step = dt * allowed * seen.normalized();
        correction += (1 - options.turned_correction) * step;
        aim_correction += options.turned_correction * step;
      }
    }
    stroke::Frame frame;
    frame.time_s = t;
    frame.controller.position = plan.tips[i] + disturbance[i] + correction;

    const Vec3 to_point = plan.intended[i] + aim_correction - plan.tips[i];
    const Vec3 forward = to_point.norm() > 1e-3
                             ? Vec3(to_point.normalized())
                             : unit_or(-plan.normals[i], -options.viewer.normalized());
    aim = f == 0 ? Gaze(dt)(forward) : carried(aim, aim_direction, forward);
    aim_direction = forward;
    // The wobble turns the aim, not the roll: only the part across the forward axis counts, two of
    // three axes, hence the root of 1.5 above.
    Vec3 turn = settled(t) * wobble(t);
    turn -= turn.dot(forward) * forward;
    if (options.coordination > 0)
      frame.controller.position -=
          options.coordination * to_point.norm() * (small_turn(turn) * forward - forward);
    turn += turn_tremor(t) + white(options.turn_noise_rad, turn_noise_random);
    frame.controller.orientation = (small_turn(turn) * aim).normalized();

    frame.head.position = heads[i];
    frame.head.orientation =
        gaze(unit_or(looked_at(i) + correction - heads[i], -options.viewer.normalized()));
    if (ink != nullptr) {
      const std::optional<Vec3> point = (*ink)(frame);
      errors.push_back(point ? Vec3(plan.intended[i] - *point) : Vec3(Vec3::Zero()));
    }
    stroke.frames.push_back(frame);
  }
  return stroke;
}

}  // namespace

stroke::Stroke simulate(const spatial::Target& target, const stroke::Intention& intended,
                        const Similarity& model_to_world, const SimulationOptions& options,
                        std::uint64_t seed) {
  return draw(target, intended, model_to_world, options, seed, nullptr);
}

stroke::Stroke simulate_closed_loop(const spatial::Target& target,
                                    const stroke::Intention& intended,
                                    const Similarity& model_to_world,
                                    const SimulationOptions& options, std::uint64_t seed,
                                    const InkFunction& ink) {
  return draw(target, intended, model_to_world, options, seed, &ink);
}

}  // namespace mimicry::study
