#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <numeric>
#include <string>
#include <utility>

#include <mimicry/base/error.h>
#include <mimicry/base/random.h>
#include <mimicry/study/simulate.h>

namespace mimicry {
namespace {

// Streams of a person's seed; trials use seeds of their own.
enum PersonStream : std::uint64_t { kPerson, kOrder, kStroke, kRecall };

double draw(const Spread& spread, Random& random) {
  return spread.median * std::exp(spread.log_deviation * random.normal());
}

// Well-mixed seeds of numbers that follow each other (splitmix64; Steele, Lea, Flood 2014).
std::uint64_t mixed(std::uint64_t seed, std::uint64_t number) {
  std::uint64_t z = seed + 0x9e3779b97f4a7c15ULL * (number + 1);
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
  return z ^ (z >> 31);
}

double world_length(const Target& target, const Intention& curve, double scale) {
  double length = 0;
  for (std::size_t i = 1; i < curve.points.size(); ++i)
    length += (target.position(curve.points[i]) - target.position(curve.points[i - 1])).norm();
  return scale * length;
}

void shuffle(std::vector<Index>& list, Random& random) {
  for (std::size_t i = list.size(); i > 1; --i)
    std::swap(list[i - 1], list[random.below(static_cast<std::uint32_t>(i))]);
}

void require_faces(const Target& target, const Intention& curve) {
  for (const SurfacePoint& p : curve.points)
    if (p.face < 0 || p.face >= target.mesh().face_count())
      throw Error(ErrorKind::invalid_input,
                  "participants: curve " + curve.name + ": face " + std::to_string(p.face) +
                      " is not in the target's " + std::to_string(target.mesh().face_count()) +
                      "; pass the mesh that the curve was made on");
}

// Where a person stands who has walked to where the curve is seen best, before drawing: within an
// angle of its mean normal, and not below the shape.
Vec3 standing_place(const Target& target, const Intention& curve, const Similarity& place,
                    const Vec3& viewer, double most_rad) {
  constexpr double kLowest = -0.3;
  Vec3 mean = Vec3::Zero();
  for (const SurfacePoint& p : curve.points) mean += place.direction(target.normal(p));
  mean /= static_cast<double>(curve.points.size());
  const Vec3 from = viewer.normalized();
  const double angle = std::atan2(from.cross(mean).norm(), from.dot(mean));
  const Vec3 axis = from.cross(mean);
  // Around a shape there is no best side.
  if (mean.norm() < 0.2 || angle <= most_rad || axis.norm() < 1e-9) return from;
  Vec3 seen = Eigen::AngleAxisd(angle - most_rad, axis.normalized()) * from;
  seen.y() = std::max(seen.y(), kLowest);
  return seen.norm() > 1e-6 ? Vec3(seen.normalized()) : from;
}

// Of the rays from the hand to the curve, those that meet another part of the shape first: in all
// of a steady stroke, or at its first point only.
double blocked_share(const Target& target, const Intention& curve, const Similarity& place,
                     SimulationOptions hand, Steering steering) {
  constexpr double kSamePart_m = 0.01;
  hand.rate_hz = 20;
  hand.drift_m = hand.tremor_m = hand.noise_m = hand.wobble_rad = 0;
  hand.turn_tremor_rad = hand.turn_noise_rad = hand.start_error_m = 0;
  const Stroke steady = simulate(target, curve, place, hand, 1);
  std::vector<Vec3> points;
  for (const SurfacePoint& p : curve.points) points.push_back(place.point(target.position(p)));
  const std::size_t frames = steering == Steering::aims ? steady.frames.size() : 1;
  std::size_t blocked = 0;
  for (std::size_t f = 0; f < frames; ++f) {
    const Pose& pen = steady.frames[f].controller;
    const auto hit = target.first_hit(place.inverse_point(pen.position),
                                      place.inverse_direction(-(pen.orientation * Vec3::UnitZ())));
    const auto is_near = [&](const Vec3& x) {
      return (x - place.point(hit->position)).norm() < kSamePart_m;
    };
    if (!hit || std::none_of(points.begin(), points.end(), is_near)) ++blocked;
  }
  return static_cast<double>(blocked) / static_cast<double>(frames);
}

// People bring the hand closer until nothing stands between it and the curve.
double seen_from(const Target& target, const Intention& curve, const Similarity& place,
                 SimulationOptions hand, Steering steering, double distance_m) {
  constexpr double kCloser = 0.65;
  constexpr int kTries = 5;
  double best = distance_m, least = 2;
  for (int i = 0; i < kTries; ++i) {
    hand.mean_distance_m = distance_m * std::pow(kCloser, i);
    const double share = blocked_share(target, curve, place, hand, steering);
    if (share < least) {
      least = share;
      best = hand.mean_distance_m;
    }
    if (least < 0.005) break;
  }
  return best;
}

}  // namespace

Participant participant(const PopulationOptions& options, std::uint64_t seed, Index number) {
  Participant person;
  person.seed = mixed(seed, static_cast<std::uint64_t>(number));
  Random random(person.seed, kPerson);
  SimulationOptions& hand = person.hand;
  person.pace = draw(options.pace, random);
  hand.tremor_m = draw(options.tremor_m, random);
  hand.noise_m = draw(options.noise_m, random);
  hand.turn_tremor_rad = draw(options.turn_tremor_rad, random);
  hand.mean_distance_m = draw(options.distance_m, random);
  hand.drift_m = draw(options.drift_m, random);
  hand.wobble_rad = draw(options.wobble_rad, random);
  hand.feedback_gain_per_s = draw(options.gain_per_s, random);
  hand.feedback_delay_s = draw(options.delay_s, random);
  hand.smoothing_m = draw(options.smoothing_m, random);
  hand.head_follow = draw(options.head_follow, random);
  hand.head_turn = options.head_turn;
  hand.facing_rad = options.facing_rad;
  hand.most_head_turn_rad_per_s = options.most_head_turn_rad_per_s;
  hand.most_corrected_m = options.most_corrected_m;
  hand.slant_rad = options.slant_rad;
  hand.start_error_m = options.start_error_m;
  return person;
}

StudySequence study_sequence(std::span<const Index> methods, std::span<const Index> shapes,
                             std::span<const Index> curve_counts, std::uint64_t seed,
                             Index number) {
  if (methods.empty() || shapes.empty() || curve_counts.size() != shapes.size() || number < 0)
    throw Error(ErrorKind::invalid_input,
                "study sequence: needs methods, shapes, and a number of curves for each shape");
  StudySequence sequence;
  sequence.methods.assign(methods.begin(), methods.end());
  const std::size_t n = methods.size();
  std::rotate(sequence.methods.begin(),
              sequence.methods.begin() + static_cast<std::ptrdiff_t>(at(number) % n),
              sequence.methods.end());
  // Two rotations of two are each other's reverse already.
  if (n > 2 && (at(number) / n) % 2 == 1)
    std::reverse(sequence.methods.begin(), sequence.methods.end());
  sequence.shapes.assign(shapes.begin(), shapes.end());
  Random random(mixed(seed, static_cast<std::uint64_t>(number)), kOrder);
  for (std::size_t s = 0; s < shapes.size(); ++s) {
    if (curve_counts[s] < 2 || curve_counts[s] % 2 != 0)
      throw Error(ErrorKind::invalid_input, "study sequence: shape " + std::to_string(shapes[s]) +
                                                " has " + std::to_string(curve_counts[s]) +
                                                " target curves; an even number is needed");
    std::vector<Index> curves(at(curve_counts[s]));
    std::iota(curves.begin(), curves.end(), 0);
    shuffle(curves, random);
    sequence.strokes.push_back(with_repeats(curves));
  }
  return sequence;
}

Intention recalled(const Target& target, const Intention& curve, std::span<const Index> keypoints,
                   double recalled_error, std::uint64_t seed) {
  require_faces(target, curve);
  const Index count = static_cast<Index>(curve.points.size());
  std::vector<Index> stations(keypoints.begin(), keypoints.end());
  std::erase_if(stations, [count](Index k) { return k < 0 || k >= count; });
  stations.push_back(0);
  stations.push_back(std::max(0, count - 1));
  std::sort(stations.begin(), stations.end());
  stations.erase(std::unique(stations.begin(), stations.end()), stations.end());
  Random random(seed, kRecall);
  Intention result = curve;
  for (std::size_t k = 0; k + 1 < stations.size(); ++k) {
    const Index begin = stations[k], end = stations[k + 1];
    std::vector<double> way = {0.0};
    for (Index i = begin; i < end; ++i)
      way.push_back(
          way.back() +
          (target.position(curve.points[at(i + 1)]) - target.position(curve.points[at(i)])).norm());
    const double total = way.back();
    // Half a wave and a whole one, which the mean square of sines makes 2.
    const double error = recalled_error * total;
    const double half = error * random.normal(), whole = error * random.normal();
    if (!(total > 0)) continue;
    for (Index i = begin + 1; i < end; ++i) {
      const double t = std::numbers::pi * way[at(i - begin)] / total;
      const Vec3 x = target.position(curve.points[at(i)]);
      const Vec3 along =
          target.position(curve.points[at(i + 1)]) - target.position(curve.points[at(i - 1)]);
      const Vec3 side = target.normal(curve.points[at(i)]).cross(along);
      if (!(side.norm() > 0)) continue;
      const auto closest = target.closest_point(
          x + (half * std::sin(t) + whole * std::sin(2 * t)) * side.normalized(), kInfinity,
          curve.points[at(i)].face);
      if (closest) result.points[at(i)] = closest->surface;
    }
  }
  return result;
}

Stroke draw_trial(const Target& target, const Intention& curve, std::span<const Index> keypoints,
                  TaskKind task, const Similarity& model_to_world, const PopulationOptions& options,
                  const Participant& person, Steering steering, std::uint64_t trial_number,
                  const InkFunction& ink) {
  require_faces(target, curve);
  const std::uint64_t seed = mixed(person.seed, trial_number);
  Random random(seed, kStroke);
  SimulationOptions hand = person.hand;
  const double longer = world_length(target, curve, model_to_world.scale) / options.usual_length_m;
  double duration = options.duration_s * person.pace *
                    std::exp(options.stroke_log_deviation * random.normal()) *
                    std::pow(std::max(longer, 1e-3), options.length_exponent);
  hand.mean_distance_m *= std::exp(options.stroke_log_deviation * random.normal());
  if (steering == Steering::aims) {
    hand.turned_correction = options.aiming_turned_correction;
    hand.coordination = options.aiming_coordination;
    hand.wrist_part = options.aiming_wrist;
    hand.facing_rad = options.aiming_facing_rad;
    hand.head_follow *= options.aiming_head;
    hand.copy = HandCopy::turned;
    hand.slant_rad = options.aiming_slant_rad;
  } else {
    hand.wobble_rad *= options.moving_wobble;
    hand.copy = HandCopy::placed;
    duration *= options.moving_pace;
  }
  hand.head_follow = std::min(1.0, hand.head_follow);
  if (task == TaskKind::re_creating) duration *= options.recalled_pace;
  hand.least_duration_s = hand.most_duration_s = std::clamp(duration, 0.5, 60.0);
  const Intention meant =
      task == TaskKind::tracing
          ? curve
          : recalled(target, curve, keypoints, options.recalled_error, mixed(seed, 1));
  hand.viewer = standing_place(target, curve, model_to_world, hand.viewer, options.standing_rad);
  hand.mean_distance_m =
      seen_from(target, meant, model_to_world, hand, steering, hand.mean_distance_m);
  Stroke stroke = simulate_closed_loop(target, meant, model_to_world, hand, seed, ink);
  stroke.intended = curve;
  return stroke;
}

}  // namespace mimicry
