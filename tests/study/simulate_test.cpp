#include <cmath>
#include <complex>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <mimicry/base/error.h>
#include <mimicry/mesh/shapes.h>
#include <mimicry/study/simulate.h>
#include <mimicry/study/targets.h>

namespace mimicry {
namespace {

struct Scene {
  Target target;
  std::vector<Intention> curves;
  Similarity place;
};

Scene scene(std::string_view shape) {
  Target target(make_shape(shape));
  auto curves = intended_curves(shape, target);
  Similarity place{Quat(Eigen::AngleAxisd(0.3, Vec3::UnitY())), Vec3(0.1, 1.2, -0.4),
                   find_shape(shape)->metres_per_unit};
  return {std::move(target), std::move(curves), place};
}

// Nothing but the planned motion.
SimulationOptions steady() {
  SimulationOptions options;
  options.drift_m = options.tremor_m = options.noise_m = 0;
  options.wobble_rad = options.turn_tremor_rad = options.turn_noise_rad = 0;
  options.aimed_start_s = 0;
  return options;
}

double mean_distance(const Scene& s, const Stroke& stroke) {
  double sum = 0;
  for (const Frame& f : stroke.frames)
    sum += s.target.closest_point(s.place.inverse_point(f.controller.position))->distance *
           s.place.scale;
  return sum / static_cast<double>(stroke.frames.size());
}

TEST(Simulate, EveryCurveOfEveryShapeGivesAUsableStrokeAtTheStudysDistance) {
  std::uint64_t seed = 1;
  for (const ShapeInfo& info : builtin_shapes()) {
    const Scene s = scene(info.name);
    for (const Intention& curve : s.curves) {
      SCOPED_TRACE(std::string(info.name) + " " + curve.name + " seed " + std::to_string(seed));
      const Stroke stroke = simulate(s.target, curve, s.place, {}, seed++);
      EXPECT_NO_THROW(require_usable(stroke));
      EXPECT_NEAR(mean_distance(s, stroke), 0.048, 0.05 * 0.048);
      const double duration = stroke.frames.back().time_s;
      EXPECT_GE(duration, 4 - 0.01);
      EXPECT_LE(duration, 5 + 0.01);
      double head_distance = 0;
      for (std::size_t i = 0; i < stroke.frames.size(); ++i) {
        const Frame& f = stroke.frames[i];
        EXPECT_NEAR(f.head.orientation.norm(), 1, 1e-12);
        EXPECT_NEAR(f.controller.orientation.norm(), 1, 1e-12);
        const Vec3 look = f.controller.position - f.head.position;
        head_distance += look.norm() / static_cast<double>(stroke.frames.size());
        // The tip is looked at, up to drift, tremor and noise (a few millimetres at 30 cm or more).
        EXPECT_GT(f.head.forward().dot(look.normalized()), 0.999);
        if (i == 0) continue;
        const Frame& before = stroke.frames[i - 1];
        EXPECT_GT(f.time_s, before.time_s);
        // No jumps: below 2 m/s and 15 rad/s.
        EXPECT_LT((f.controller.position - before.controller.position).norm(), 2.0 / 90);
        EXPECT_LT(f.controller.orientation.angularDistance(before.controller.orientation),
                  15.0 / 90);
        EXPECT_LT((f.head.position - before.head.position).norm(), 1.0 / 90);
        EXPECT_LT(f.head.orientation.angularDistance(before.head.orientation), 6.0 / 90);
      }
      EXPECT_NEAR(head_distance, 0.45, 0.12);
    }
  }
}

TEST(Simulate, SameSeedSameBitsAndOtherSeedOtherStroke) {
  const Scene s = scene("torus");
  const auto a = simulate(s.target, s.curves[1], s.place, {}, 7);
  const auto b = simulate(s.target, s.curves[1], s.place, {}, 7);
  const auto c = simulate(s.target, s.curves[1], s.place, {}, 8);
  ASSERT_EQ(a.frames.size(), b.frames.size());
  for (std::size_t i = 0; i < a.frames.size(); ++i) {
    EXPECT_EQ(a.frames[i].controller.position, b.frames[i].controller.position);
    EXPECT_EQ(a.frames[i].controller.orientation.coeffs(),
              b.frames[i].controller.orientation.coeffs());
    EXPECT_EQ(a.frames[i].head.position, b.frames[i].head.position);
  }
  EXPECT_NE(a.frames[20].controller.position, c.frames[20].controller.position);
  EXPECT_EQ(a.intended->points.size(), s.curves[1].points.size());
}

TEST(Simulate, TremorLiesInItsBandWithItsSize) {
  // Without distance the plan is the same with and without tremor: the difference is the tremor.
  const Scene s = scene("sphere");
  SimulationOptions still = steady();
  still.mean_distance_m = 0;
  SimulationOptions trembling = still;
  trembling.tremor_m = 0.2e-3;
  for (const std::uint64_t seed : {1, 2, 3}) {
    const auto a = simulate(s.target, s.curves[0], s.place, still, seed);
    const auto b = simulate(s.target, s.curves[0], s.place, trembling, seed);
    const std::size_t n = a.frames.size();
    double in_band = 0, total = 0, squares = 0;
    for (int axis = 0; axis < 3; ++axis)
      for (std::size_t k = 1; k < n / 2; ++k) {
        std::complex<double> sum = 0;
        for (std::size_t i = 0; i < n; ++i) {
          const double d =
              b.frames[i].controller.position[axis] - a.frames[i].controller.position[axis];
          const double angle =
              2 * std::numbers::pi * static_cast<double>(i * k % n) / static_cast<double>(n);
          // A window keeps the ends' step out of the other frequencies.
          const double window = 0.5 - 0.5 * std::cos(2 * std::numbers::pi * static_cast<double>(i) /
                                                     static_cast<double>(n));
          sum += window * d * std::polar(1.0, angle);
          if (k == 1) squares += d * d;
        }
        const double hz = static_cast<double>(k) * 90 / static_cast<double>(n);
        total += std::norm(sum);
        if (hz > 7.5 && hz < 12.5) in_band += std::norm(sum);
      }
    EXPECT_GT(in_band / total, 0.99) << seed;
    // 36 sinusoids of fixed amplitude: only their beats over 4 to 5 s are left to chance.
    EXPECT_NEAR(std::sqrt(squares / static_cast<double>(n)), 0.2e-3, 0.2 * 0.2e-3) << seed;
  }
}

TEST(Simulate, DriftIsSlowAndNoiseIsWhite) {
  const Scene s = scene("sphere");
  SimulationOptions still = steady();
  still.mean_distance_m = 0;
  SimulationOptions drifting = still, noisy = still;
  drifting.drift_m = 0.0025;
  noisy.noise_m = 0.1e-3;
  const auto a = simulate(s.target, s.curves[0], s.place, still, 4);
  const auto b = simulate(s.target, s.curves[0], s.place, drifting, 4);
  const auto c = simulate(s.target, s.curves[0], s.place, noisy, 4);
  double drift = 0, drift_speed = 0, noise = 0, lagged = 0;
  Vec3 last_drift = Vec3::Zero(), last_noise = Vec3::Zero();
  for (std::size_t i = 0; i < a.frames.size(); ++i) {
    const Vec3 d = b.frames[i].controller.position - a.frames[i].controller.position;
    const Vec3 w = c.frames[i].controller.position - a.frames[i].controller.position;
    drift += d.squaredNorm();
    noise += w.squaredNorm();
    if (i > 0) {
      drift_speed += (d - last_drift).squaredNorm() * 90 * 90;
      lagged += w.dot(last_noise);
    }
    last_drift = d;
    last_noise = w;
  }
  const auto n = static_cast<double>(a.frames.size());
  EXPECT_NEAR(std::sqrt(drift / n), 0.0025, 0.0008);  // few periods fit into the stroke
  // Speed / size is the mean angular frequency: below 2 pi 1 Hz.
  EXPECT_LT(std::sqrt(drift_speed / drift), 2 * std::numbers::pi * 0.9);
  // 3 n samples: standard error 1 / sqrt(6 n) = 2 % of the size, 1 / sqrt(3 n) = 3 % of the lag.
  EXPECT_NEAR(std::sqrt(noise / n), 0.1e-3, 0.1 * 0.1e-3);
  EXPECT_LT(std::abs(lagged / noise), 0.12);
}

TEST(Simulate, SpeedFollowsTheTwoThirdsPowerLaw) {
  // On an ellipse, away from start and stop: slope of log speed over log curvature.
  const Scene s = scene("grid");
  Intention ellipse{"ellipse", true, {}};
  for (int i = 0; i <= 400; ++i) {
    const double t = 2 * std::numbers::pi * i / 400;
    ellipse.points.push_back(
        s.target.closest_point(Vec3(0.8 * std::cos(t), 0.4 * std::sin(t), 0))->surface);
  }
  SimulationOptions options = steady();
  options.least_curvature = 1e-3;
  options.smoothing_m = 0.005;
  const auto stroke = simulate(s.target, ellipse, s.place, options, 3);
  double sx = 0, sy = 0, sxx = 0, sxy = 0, n = 0;
  for (std::size_t i = 40; i + 40 < stroke.frames.size(); i += 2) {
    const Vec3 a = stroke.frames[i - 4].controller.position;
    const Vec3 b = stroke.frames[i].controller.position;
    const Vec3 c = stroke.frames[i + 4].controller.position;
    const double area = (b - a).cross(c - a).norm();
    const double curvature = 2 * area / ((b - a).norm() * (c - b).norm() * (c - a).norm());
    const double x = std::log(curvature), y = std::log((c - a).norm());
    sx += x, sy += y, sxx += x * x, sxy += x * y, ++n;
  }
  EXPECT_NEAR((n * sxy - sx * sy) / (n * sxx - sx * sx), -1.0 / 3, 0.04);
}

TEST(Simulate, ControllerPointsAtTheIntendedCurve) {
  // Share of frames whose spray ray hits within 15 mm of the intended curve: 8 degrees at 4.8 cm
  // are 7 mm.
  int near = 0, all = 0;
  for (const char* shape : {"sphere", "cube", "torus", "hand", "rounded-cube"}) {
    const Scene s = scene(shape);
    for (const Intention& curve : s.curves) {
      const auto stroke = simulate(s.target, curve, s.place, {}, 5);
      for (const Frame& world : stroke.frames) {
        const Frame f = to_model(world, s.place);
        const auto hit = s.target.first_hit(f.controller.position, f.controller.forward());
        double nearest = kInfinity;
        if (hit)
          for (const SurfacePoint& p : curve.points)
            nearest = std::min(nearest, (s.target.position(p) - hit->position).norm());
        near += nearest * s.place.scale < 0.015;
        ++all;
      }
    }
  }
  EXPECT_GT(near, 0.8 * all);
  EXPECT_LT(near, all);  // and it does wobble
}

TEST(Simulate, TheStartIsAimed) {
  const Scene s = scene("cube");
  for (const Intention& curve : s.curves)
    for (const std::uint64_t seed : {1, 2, 3}) {
      const auto stroke = simulate(s.target, curve, s.place, {}, seed);
      const Frame f = to_model(stroke.frames.front(), s.place);
      const auto hit = s.target.first_hit(f.controller.position, f.controller.forward());
      ASSERT_TRUE(hit);
      // Tremor and noise of position and direction, 0.1 degrees at 5 to 10 cm.
      EXPECT_LT((hit->position - s.target.position(curve.points.front())).norm() * s.place.scale,
                0.001);
    }
}

TEST(Simulate, WobbleHasItsSize) {
  const Scene s = scene("grid");
  SimulationOptions options = steady();
  options.wobble_rad = 8 * std::numbers::pi / 180;
  double squares = 0, count = 0;
  for (const std::uint64_t seed : {1, 2, 3, 4, 5, 6}) {
    const auto calm = simulate(s.target, s.curves[0], s.place, steady(), seed);
    const auto wobbling = simulate(s.target, s.curves[0], s.place, options, seed);
    for (std::size_t i = 0; i < calm.frames.size(); ++i) {
      const double angle = std::acos(std::min(
          1.0, calm.frames[i].controller.forward().dot(wobbling.frames[i].controller.forward())));
      squares += angle * angle;
      ++count;
    }
  }
  EXPECT_NEAR(std::sqrt(squares / count) * 180 / std::numbers::pi, 8, 1.6);
}

TEST(Simulate, FeedbackRemovesAConstantError) {
  const Scene s = scene("grid");
  const Vec3 bias = s.place.direction(Vec3(0.01, 0, 0));
  // Ink: straight below the tip, one centimetre to the side.
  const InkFunction ink = [&](const Frame& frame) -> std::optional<Vec3> {
    const Vec3 model = s.place.inverse_point(frame.controller.position);
    return s.place.point(Vec3(model[0], model[1], 0)) + bias;
  };
  SimulationOptions options = steady();
  options.smoothing_m = 0;
  const auto error_at_end = [&](const Stroke& stroke) {
    return (*ink(stroke.frames.back()) -
            s.place.point(s.target.position(s.curves[1].points.back())))
        .norm();
  };
  const auto open = simulate(s.target, s.curves[1], s.place, options, 2);
  int calls = 0;
  const auto closed =
      simulate_closed_loop(s.target, s.curves[1], s.place, options, 2, [&](const Frame& f) {
        ++calls;
        return ink(f);
      });
  EXPECT_EQ(calls, static_cast<int>(closed.frames.size()));
  EXPECT_NEAR(error_at_end(open), 0.01, 1e-6);
  EXPECT_LT(error_at_end(closed), 0.0005);
  // For the first 150 ms nothing can have been seen.
  for (int i = 0; i < 13; ++i)
    EXPECT_EQ(open.frames[i].controller.position, closed.frames[i].controller.position);
  // Misses are not corrected.
  const auto missing = simulate_closed_loop(s.target, s.curves[1], s.place, options, 2,
                                            [](const Frame&) { return std::nullopt; });
  EXPECT_EQ(missing.frames.back().controller.position, open.frames.back().controller.position);
}

TEST(Simulate, ACopyTurnsOnlyBeyondItsSlant) {
  const Scene s = scene("torus");
  const Intention& curve = s.curves[1];
  SimulationOptions options = steady();
  options.copy = HandCopy::translated;
  const Stroke translated = simulate(s.target, curve, s.place, options, 3);
  const auto farthest = [&](HandCopy copy, double slant_rad) {
    options.copy = copy;
    options.slant_rad = slant_rad;
    const Stroke stroke = simulate(s.target, curve, s.place, options, 3);
    double most = 0;
    for (std::size_t i = 0; i < stroke.frames.size(); ++i)
      most = std::max(
          most,
          (stroke.frames[i].controller.position - translated.frames[i].controller.position).norm());
    return most;
  };
  EXPECT_LT(farthest(HandCopy::turned, std::numbers::pi), 1e-9);
  EXPECT_LT(farthest(HandCopy::placed, std::numbers::pi), 1e-9);
  EXPECT_GT(farthest(HandCopy::turned, 0.3), 0.01);
}

TEST(Simulate, InkOnAnotherPartIsNotChased) {
  const Scene s = scene("torus");
  SimulationOptions options = steady();
  const Stroke open = simulate(s.target, s.curves[1], s.place, options, 2);
  const auto moved = [&](double most_corrected_m) {
    options.most_corrected_m = most_corrected_m;
    const Stroke stroke = simulate_closed_loop(
        s.target, s.curves[1], s.place, options, 2,
        [](const Frame& f) { return Vec3(f.controller.position + Vec3(1, 0, 0)); });
    return (stroke.frames.back().controller.position - open.frames.back().controller.position)
        .norm();
  };
  const double seconds = open.frames.back().time_s;
  EXPECT_NEAR(moved(1000), options.most_correction_m_per_s * (seconds - options.feedback_delay_s),
              0.02);
  EXPECT_LE(moved(0.01), options.feedback_gain_per_s * 0.01 * seconds);
}

TEST(Simulate, FrameRatesGiveTheSameMotion) {
  const Scene s = scene("torus");
  const SimulationOptions calm = steady();
  const auto reference = simulate(s.target, s.curves[0], s.place, calm, 9);
  for (const double rate : {20.0, 50.0, 240.0, 1000.0}) {
    SimulationOptions options = calm;
    options.rate_hz = rate;
    const auto stroke = simulate(s.target, s.curves[0], s.place, options, 9);
    // The duration is rounded to frames.
    EXPECT_NEAR(stroke.frames.back().time_s, reference.frames.back().time_s, 0.5 / rate + 0.5 / 90);
    const std::size_t middle = stroke.frames.size() / 2;
    const auto same = static_cast<std::size_t>(
        std::lround(stroke.frames[middle].time_s / reference.frames.back().time_s *
                    (reference.frames.size() - 1)));
    // Half a frame's way at about 0.4 m/s, and the duration's rounding.
    EXPECT_LT(
        (stroke.frames[middle].controller.position - reference.frames[same].controller.position)
            .norm(),
        0.012)
        << rate;
  }
}

TEST(Simulate, ScaledTargetsGiveTheSameWorldStroke) {
  const Scene s = scene("torus");
  const auto reference = simulate(s.target, s.curves[0], s.place, {}, 9);
  for (const double factor : {1e-6, 1e6}) {
    std::vector<Vec3> positions(s.target.mesh().positions().begin(),
                                s.target.mesh().positions().end());
    for (Vec3& p : positions) p *= factor;
    const Target scaled(s.target.mesh().with_positions(positions));
    Similarity place = s.place;
    place.scale /= factor;
    const auto stroke = simulate(scaled, s.curves[0], place, {}, 9);
    for (std::size_t i = 0; i < stroke.frames.size(); ++i)
      EXPECT_LT(
          (stroke.frames[i].controller.position - reference.frames[i].controller.position).norm(),
          1e-6);
  }
}

TEST(Simulate, RefusesWhatItCannotDraw) {
  const Scene s = scene("sphere");
  const auto refused = [&](const Intention& curve, const SimulationOptions& options) {
    EXPECT_THROW(simulate(s.target, curve, s.place, options, 1), Error);
  };
  refused({"empty", false, {}}, {});
  refused({"point", true, {s.curves[0].points[0]}}, {});
  refused({"foreign", false, {{0, Vec3(1, 0, 0)}, {1 << 28, Vec3(1, 0, 0)}}}, {});
  for (const double rate : {19.0, 1001.0, std::nan("")}) {
    SimulationOptions options;
    options.rate_hz = rate;
    refused(s.curves[0], options);
  }
  SimulationOptions negative;
  negative.tremor_m = -1;
  refused(s.curves[0], negative);
}

}  // namespace
}  // namespace mimicry
