#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include <mimicry/base/random.h>
#include <mimicry/study/simulate.h>

#include "base/finite.h"
#include "study/hand_path.h"
#include "study/simulation_check.h"

namespace mimicry {
namespace {

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

// Zero-phase low pass in time: an exponential filter there and back.
void low_pass(std::vector<Vec3>& x, double dt, double tau) {
  const double keep = std::exp(-dt / tau);
  for (std::size_t i = 1; i < x.size(); ++i) x[i] = keep * x[i - 1] + (1 - keep) * x[i];
  for (std::size_t i = x.size() - 1; i-- > 0;) x[i] = keep * x[i + 1] + (1 - keep) * x[i];
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
  return angle > 0 ? Quat(Eigen::AngleAxisd(angle, rotation / angle)) : Quat(Quat::Identity());
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

Stroke draw(const Target& target, const Intention& intended, const Similarity& place,
            const SimulationOptions& options, std::uint64_t seed, const InkFunction* ink) {
  check_simulation(options);
  if (!std::isfinite(place.scale) || place.scale <= 0 || !is_finite(place.translation) ||
      !is_finite(place.rotation))
    refuse_simulation("the target's place must be finite and its scale positive");
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

  Stroke stroke;
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
    Frame frame;
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

Stroke simulate(const Target& target, const Intention& intended, const Similarity& model_to_world,
                const SimulationOptions& options, std::uint64_t seed) {
  return draw(target, intended, model_to_world, options, seed, nullptr);
}

Stroke simulate_closed_loop(const Target& target, const Intention& intended,
                            const Similarity& model_to_world, const SimulationOptions& options,
                            std::uint64_t seed, const InkFunction& ink) {
  return draw(target, intended, model_to_world, options, seed, &ink);
}

}  // namespace mimicry
