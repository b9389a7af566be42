#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <mimicry/mimicry.h>

#include "handles.h"

namespace {

using namespace mimicry::test;
using testing::HasSubstr;

using TargetCurves = std::unique_ptr<mimicry_target_curves, Destroy<mimicry_target_curves_destroy>>;

const mimicry_similarity kHere{{0, 0, 0, 1}, {0, 1.2, 0}, 0.2};

// An arc over the top of a sphere.
std::vector<mimicry_surface_point> arc(const Target& target, int count = 60) {
  std::vector<double> queries;
  for (int i = 0; i < count; ++i) {
    const double a = -0.8 + 1.6 * i / (count - 1);
    queries.insert(queries.end(), {std::sin(a), 0.2 * std::sin(3 * a), std::cos(a)});
  }
  std::vector<mimicry_surface_point> points(static_cast<std::size_t>(count));
  EXPECT_EQ(mimicry_target_closest_points(target.get(), queries.data(), points.size(), INFINITY,
                                          points.data()),
            MIMICRY_OK);
  return points;
}

TEST(CApiStudy, ASimulatedStrokeIsDrawnAndMeasured) {
  const Target target = target_of("sphere", 12);
  const auto intended = arc(target);
  const auto strokes = make<Strokes>(mimicry_strokes_create);
  mimicry_simulation_options options = mimicry_default_simulation_options();
  EXPECT_EQ(options.rate_hz, 90.0);
  options.rate_hz = 60;
  const auto simulate = [&](const char* technique, const char* id, uint32_t seed) {
    return mimicry_strokes_simulate(strokes.get(), target.get(), technique, id, nullptr, &kHere,
                                    intended.data(), intended.size(), &options, seed);
  };
  ASSERT_EQ(simulate(nullptr, "blind", 3), MIMICRY_OK) << mimicry_last_error();
  ASSERT_EQ(simulate(nullptr, "again", 3), MIMICRY_OK);
  ASSERT_EQ(simulate("mimicry-live", "seen", 3), MIMICRY_OK);
  ASSERT_EQ(mimicry_strokes_count(strokes.get()), 3u);
  EXPECT_STREQ(mimicry_strokes_id(strokes.get(), 2), "seen");
  const auto frames_of = [&](std::size_t number) {
    std::vector<mimicry_frame> frames(mimicry_strokes_frame_count(strokes.get(), number));
    EXPECT_EQ(mimicry_strokes_frames(strokes.get(), number, frames.data()), MIMICRY_OK);
    return frames;
  };
  const auto blind = frames_of(0), again = frames_of(1), seen = frames_of(2);
  ASSERT_GT(blind.size(), 200u) << "four seconds at 60 Hz";
  ASSERT_EQ(blind.size(), again.size());
  for (std::size_t i = 0; i < blind.size(); ++i)
    ASSERT_EQ(blind[i].controller_position[0], again[i].controller_position[0]);
  // The file says that they are simulated.
  const auto file = make<Bytes>(mimicry_strokes_write, strokes.get());
  const std::string text(reinterpret_cast<const char*>(mimicry_bytes_data(file.get())),
                         mimicry_bytes_size(file.get()));
  EXPECT_THAT(text, HasSubstr("mimicry-live"));

  const auto session = make<Session>(mimicry_session_create, target.get(), "mimicry-live");
  const auto measured = [&](const std::vector<mimicry_frame>& frames) {
    const auto curve =
        make<Curve>(mimicry_session_project, session.get(), &kHere, frames.data(), frames.size());
    const int32_t keypoints[] = {0, 30, 59};
    mimicry_measures m{};
    EXPECT_EQ(mimicry_measure(curve.get(), &kHere, frames.data(), frames.size(), intended.data(),
                              intended.size(), keypoints, 3, 1, &m),
              MIMICRY_OK)
        << mimicry_last_error();
    return m;
  };
  const mimicry_measures open = measured(blind), closed = measured(seen);
  EXPECT_GT(open.l_x_m, 0.3);
  EXPECT_LT(open.l_x_m, 0.5);
  EXPECT_GT(open.d_ep_m, 0.0);
  EXPECT_LT(closed.d_ep_m, open.d_ep_m) << "who sees the ink corrects it";
  EXPECT_LT(closed.d_ep_m, 0.02);
  EXPECT_GT(closed.tau_s, 3.9);
  EXPECT_EQ(closed.inverted, 0);
  EXPECT_EQ(closed.gaps, 0);

  options.rate_hz = kNaN;
  EXPECT_EQ(simulate(nullptr, "x", 1), MIMICRY_INVALID_INPUT);
  options = mimicry_default_simulation_options();
  options.copy = static_cast<mimicry_hand_copy>(17);
  expect_invalid(simulate(nullptr, "x", 1), "mimicry_hand_copy");
  options = mimicry_default_simulation_options();
  expect_invalid(simulate("mimicry", "x", 1), "bake");
  expect_invalid(simulate("magic", "x", 1), "spraycan");
  expect_invalid(simulate(nullptr, nullptr, 1), "id is NULL");
  expect_invalid(mimicry_strokes_simulate(strokes.get(), target.get(), nullptr, "x", nullptr,
                                          &kHere, nullptr, 5, nullptr, 1),
                 "intended point is NULL");
  EXPECT_EQ(mimicry_strokes_simulate(strokes.get(), target.get(), nullptr, "x", nullptr, &kHere,
                                     intended.data(), 1, nullptr, 1),
            MIMICRY_INVALID_INPUT);
  EXPECT_EQ(mimicry_strokes_count(strokes.get()), 3u);
}

TEST(CApiStudy, MeasuringRefusesWhatItCannotMeasure) {
  const Target target = target_of("sphere", 8);
  const auto intended = arc(target, 20);
  const auto session = make<Session>(mimicry_session_create, target.get(), "snap");
  const auto frames = wave(30);
  const auto curve =
      make<Curve>(mimicry_session_project, session.get(), &kHere, frames.data(), frames.size());
  mimicry_measures m{};
  m.d_ep_m = 77.0;
  const auto measure = [&](const mimicry_frame* f, std::size_t n, const mimicry_surface_point* x,
                           std::size_t points, const int32_t* keys, std::size_t key_count) {
    return mimicry_measure(curve.get(), &kHere, f, n, x, points, keys, key_count, 1, &m);
  };
  EXPECT_EQ(measure(frames.data(), 0, intended.data(), 20, nullptr, 0), MIMICRY_INVALID_INPUT);
  expect_invalid(measure(nullptr, 30, intended.data(), 20, nullptr, 0), "frames is NULL");
  expect_invalid(measure(frames.data(), 30, nullptr, 20, nullptr, 0), "intended point is NULL");
  expect_invalid(measure(frames.data(), 30, intended.data(), 1, nullptr, 0), "no length");
  const int32_t beyond[] = {0, 20};
  expect_invalid(measure(frames.data(), 30, intended.data(), 20, beyond, 2), "keypoint 20");
  auto odd = frames;
  odd[4].time_s = kNaN;
  EXPECT_EQ(measure(odd.data(), 30, intended.data(), 20, nullptr, 0), MIMICRY_INVALID_INPUT);
  expect_invalid(
      mimicry_measure(nullptr, &kHere, frames.data(), 30, intended.data(), 20, nullptr, 0, 1, &m),
      "curve is NULL");
  EXPECT_EQ(m.d_ep_m, 77.0) << "nothing is written on failure";
}

TEST(CApiStudy, KeypointsAreEndsAndBends) {
  const Target target = target_of("sphere", 12);
  const auto points = arc(target, 80);
  std::vector<int32_t> numbers(points.size(), -1);
  std::size_t found = 0;
  ASSERT_EQ(
      mimicry_keypoints(target.get(), points.data(), points.size(), 0.2, numbers.data(), &found),
      MIMICRY_OK)
      << mimicry_last_error();
  ASSERT_GE(found, 3u);
  EXPECT_EQ(numbers[0], 0);
  EXPECT_EQ(numbers[found - 1], 79);
  for (std::size_t i = 1; i < found; ++i) EXPECT_GT(numbers[i], numbers[i - 1]);
  expect_invalid(mimicry_keypoints(target.get(), points.data(), 80, 0.0, numbers.data(), &found),
                 "metres_per_unit");
  expect_invalid(mimicry_keypoints(target.get(), points.data(), 80, 0.2, nullptr, &found),
                 "numbers is NULL");
  expect_invalid(mimicry_keypoints(target.get(), nullptr, 80, 0.2, numbers.data(), &found),
                 "point is NULL");
}

TEST(CApiStudy, TargetCurvesAreSampledWrittenAndRead) {
  const auto mesh = make<Mesh>(mimicry_mesh_shape, "sphere", 6);
  const auto target = make<Target>(mimicry_target_make, mesh.get(), nullptr);
  mimicry_target_curves* none = nullptr;
  const auto sample = [&](const Target& on, std::size_t count, double scale,
                          const mimicry_sampling_options* options) {
    return mimicry_target_curves_sample(on.get(), count, 5, scale, options, nullptr, nullptr,
                                        &none);
  };
  expect_invalid(sample(target, 1, 0.2, nullptr), "bake");

  mimicry_bake_options baking = mimicry_default_bake_options();
  baking.samples = 100;
  const auto baked = make<Bytes>(mimicry_bake, mesh.get(), &baking, nullptr, nullptr);
  const auto smooth =
      make<Target>(mimicry_target_with_embedding, target.get(), mimicry_bytes_data(baked.get()),
                   mimicry_bytes_size(baked.get()), "sphere.mimicry");
  mimicry_sampling_options options = mimicry_default_sampling_options();
  options.points = 101;
  options.most_attempts = 1000;
  const auto curves = make<TargetCurves>(mimicry_target_curves_sample, smooth.get(), std::size_t{2},
                                         5u, 0.2, &options, nullptr, nullptr);
  ASSERT_EQ(mimicry_target_curves_count(curves.get()), 2u);
  EXPECT_EQ(mimicry_target_curves_metres_per_unit(curves.get()), 0.2);
  ASSERT_EQ(mimicry_target_curves_point_count(curves.get(), 1), 101u);
  std::vector<mimicry_surface_point> points(101);
  ASSERT_EQ(mimicry_target_curves_points(curves.get(), 1, target.get(), points.data()), MIMICRY_OK);
  for (const auto& p : points)
    EXPECT_NEAR(std::hypot(p.position[0], p.position[1], p.position[2]), 1.0, 0.05);
  const std::size_t keypoints = mimicry_target_curves_keypoint_count(curves.get(), 1);
  ASSERT_GE(keypoints, 2u);
  EXPECT_EQ(mimicry_target_curves_keypoints(curves.get(), 1)[keypoints - 1], 100);

  const auto file = make<Bytes>(mimicry_target_curves_write, curves.get(), "ball", "for a test");
  const auto read = make<TargetCurves>(mimicry_target_curves_read, mimicry_bytes_data(file.get()),
                                       mimicry_bytes_size(file.get()), "t.json", nullptr);
  std::vector<mimicry_surface_point> again(101);
  ASSERT_EQ(mimicry_target_curves_points(read.get(), 1, target.get(), again.data()), MIMICRY_OK);
  for (std::size_t i = 0; i < 101; ++i)
    EXPECT_NEAR(again[i].position[0], points[i].position[0], 1e-12);

  EXPECT_EQ(mimicry_target_curves_read(mimicry_bytes_data(file.get()),
                                       mimicry_bytes_size(file.get()), "t.json", "cube", &none),
            MIMICRY_INVALID_INPUT);
  EXPECT_EQ(mimicry_target_curves_read("{", 1, "t.json", nullptr, &none), MIMICRY_INVALID_INPUT);
  expect_invalid(sample(smooth, 0, 0.2, &options), "1 to 1000");
  expect_invalid(sample(smooth, 1, kNaN, &options), "metres_per_unit");
  options.controls = 2;
  EXPECT_EQ(sample(smooth, 1, 0.2, &options), MIMICRY_INVALID_INPUT);
  EXPECT_EQ(none, nullptr);
  options = mimicry_default_sampling_options();
  EXPECT_EQ(mimicry_target_curves_sample(
                smooth.get(), 2, 5, 0.2, &options,
                [](void*, const char*, double) -> int32_t { return 0; }, nullptr, &none),
            MIMICRY_CANCELLED);
  EXPECT_EQ(mimicry_target_curves_point_count(curves.get(), 2), 0u);
  EXPECT_EQ(mimicry_target_curves_keypoints(curves.get(), 2), nullptr);
  expect_invalid(mimicry_target_curves_points(curves.get(), 2, target.get(), points.data()),
                 "curve 2 of 2");
  const Target other = target_of("cube", 1);
  EXPECT_EQ(mimicry_target_curves_points(curves.get(), 1, other.get(), points.data()),
            MIMICRY_INVALID_INPUT);
}

}  // namespace
