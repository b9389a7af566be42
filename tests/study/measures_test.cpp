#include <cmath>
#include <numbers>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <mimicry/base/error.h>
#include <mimicry/geodesic/paths.h>
#include <mimicry/mesh/shapes.h>
#include <mimicry/spatial/target.h>
#include <mimicry/study/measures.h>
#include <mimicry/study/recording.h>

#include "curve/curve_builder.h"
#include "study/polyline.h"

namespace mimicry {
namespace {

using std::numbers::pi;

// A drawing on a target: the curve, and a hand that moves with it.
struct Drawing {
  ProjectedCurve curve;
  std::vector<MotionSample> motion;
};

Drawing draw(const Target& target, std::span<const SurfacePoint> points, double scale,
             const Vec3& offset = Vec3::Zero()) {
  CurveBuilder builder(target.surface());
  Drawing drawing;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double t = 0.01 * static_cast<double>(i);
    const Vec3 x = target.position(points[i]);
    builder.append({points[i], x, Vec3::UnitZ(), static_cast<Index>(i), t, 0.0});
    MotionSample sample;
    sample.time_s = t;
    sample.pen = scale * x + offset;
    drawing.motion.push_back(sample);
  }
  drawing.curve = builder.curve();
  return drawing;
}

std::vector<SurfacePoint> on(const Target& target, std::span<const Vec3> positions) {
  std::vector<SurfacePoint> points;
  for (const Vec3& x : positions) points.push_back(target.closest_point(x)->surface);
  return points;
}

Measures measure_on(const Target& target, const TargetCurve& intended, const Drawing& drawing,
                    double scale) {
  return measure(target.surface(), intended_curve(target.mesh(), intended, scale), drawing.curve,
                 drawing.motion);
}

// A circle of latitude around z on a sphere of radius 1.
std::vector<Vec3> latitude(double polar, int count) {
  std::vector<Vec3> circle;
  for (int i = 0; i <= count; ++i) {
    const double a = 2.0 * pi * i / count;
    circle.push_back(
        Vec3(std::sin(polar) * std::cos(a), std::sin(polar) * std::sin(a), std::cos(polar)));
  }
  return circle;
}

TEST(Measures, ACircleOnASphereHasItsGeodesicCurvature) {
  const Target sphere(make_sphere(48));
  const double polar = 0.6, scale = 0.3;
  const std::vector<SurfacePoint> points = on(sphere, latitude(polar, 60));
  const Measures m = measure_on(sphere, {points, {}, {}}, draw(sphere, points, scale), scale);
  // The circle turns by 2 pi cos(polar) in all (Gauss and Bonnet), on 2 pi sin(polar); the first
  // point of the circle does not count, which is a sixtieth.
  const double expected = 2.0 * pi * std::cos(polar) * (59.0 / 60.0);
  EXPECT_NEAR(m.l_x_m, 2.0 * pi * std::sin(polar) * scale, 0.01 * m.l_x_m);
  EXPECT_NEAR(m.k_g_rad_per_m * m.l_x_m, expected, 0.01 * expected);
  // In space the circle itself turns by 2 pi.
  EXPECT_GT(m.k_e_rad_per_m * m.l_x_m, 2.0 * pi * 59.0 / 60.0);
}

TEST(Measures, AStraightestGeodesicHasNone) {
  const Target torus(make_torus(48, 20));
  std::vector<SurfacePoint> points;
  SurfacePoint p{100, {0.4, 0.35, 0.25}};
  Vec3 direction = torus.mesh().corner(100, 1) - torus.mesh().corner(100, 0);
  for (int i = 0; i < 40; ++i) {
    points.push_back(p);
    const auto trace = trace_straightest(torus.surface(), p, direction, 0.03);
    p = trace.end;
    direction = trace.direction;
  }
  const Measures m = measure_on(torus, {points, {}, {}}, draw(torus, points, 0.4), 0.4);
  // Each of the 40 points is known to rounding; steps of 0.03 lose no more than four digits.
  EXPECT_LT(m.k_g_rad_per_m, 1e-8);
  EXPECT_LT(m.f_g_rad_per_m, 1e-8);
  EXPECT_GT(m.k_e_rad_per_m, 1.0);
}

TEST(Measures, ATranslatedCopyOfTheTargetIsMeasuredAsOne) {
  const Target grid(make_grid(20));
  std::vector<Vec3> wave;
  for (int i = 0; i <= 200; ++i)
    wave.push_back(Vec3(-0.8 + 0.008 * i, 0.3 * std::sin(0.05 * i), 0.0));
  const TargetCurve intended{on(grid, wave), {0, 60, 120, 200}, {}};
  const double scale = 0.5;
  const Drawing drawing = draw(grid, intended.points, scale, Vec3(0.01, -0.02, 0.05));
  const Measures m = measure_on(grid, intended, drawing, scale);
  EXPECT_LT(m.mimicry_violation, 1e-12);
  EXPECT_LT(m.d_ep_m + m.d_sym_m + m.frechet_m + m.end_lag_m, 1e-12);
  EXPECT_NEAR(m.length_ratio, 1.0, 1e-12);
  EXPECT_NEAR(m.largest_jump, 1.0, 1e-9);
  EXPECT_EQ(m.share_jumping, 0.0);
  EXPECT_TRUE(m.filters.passed());
  EXPECT_NEAR(m.tau_s, 2.0, 1e-12);
  EXPECT_EQ(m.r_c_rad_per_m, 0.0);
  EXPECT_EQ(m.t_h, 0.0);
}

TEST(Measures, AShiftedCurveIsItsShiftAway) {
  const Target grid(make_grid(20));
  const std::vector<Vec3> line = {Vec3(-0.5, 0, 0), Vec3(0.5, 0, 0)};
  const std::vector<Vec3> shifted = {Vec3(-0.5, 0.1, 0), Vec3(0, 0.1, 0), Vec3(0.5, 0.1, 0)};
  const Measures m =
      measure_on(grid, {on(grid, line), {}, {}}, draw(grid, on(grid, shifted), 1.0), 1.0);
  for (const double d : {m.d_ep_m, m.d_sym_m, m.frechet_m, m.end_lag_m}) EXPECT_NEAR(d, 0.1, 1e-12);
}

TEST(Measures, ARightAngleCountsOnceInK_gAndTwiceInF_g) {
  const Target grid(make_grid(10));
  const std::vector<Vec3> corner = {Vec3(-0.5, 0.03, 0), Vec3(0.05, 0.03, 0), Vec3(0.05, 0.6, 0)};
  const std::vector<SurfacePoint> points = on(grid, corner);
  const Measures m = measure_on(grid, {points, {}, {}}, draw(grid, points, 1.0), 1.0);
  EXPECT_NEAR(m.k_g_rad_per_m * m.l_x_m, pi / 2.0, 1e-9);
  EXPECT_NEAR(m.k_e_rad_per_m * m.l_x_m, pi / 2.0, 1e-9);
  // From an edge crossing (0) to the corner, and to the next crossing.
  EXPECT_NEAR(m.f_g_rad_per_m * m.l_x_m, pi, 1e-9);
}

TEST(Measures, GapsAreJoinedOrLeftOut) {
  const Target grid(make_grid(10));
  const std::vector<Vec3> corner = {Vec3(-0.5, 0.03, 0), Vec3(-0.1, 0.03, 0), Vec3(0.05, 0.03, 0),
                                    Vec3(0.05, 0.6, 0)};
  const std::vector<SurfacePoint> points = on(grid, corner);
  Drawing drawing = draw(grid, points, 1.0);
  CurveBuilder builder(grid.surface());
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (i == 3) builder.break_here();
    builder.append(drawing.curve.points[i]);
  }
  const IntendedCurve intended = intended_curve(grid.mesh(), {points, {}, {}}, 1.0);
  const auto with = [&](bool join) {
    return measure(grid.surface(), intended, builder.curve(), drawing.motion, {join});
  };
  EXPECT_NEAR(with(true).k_g_rad_per_m * intended.length_m, pi / 2.0, 1e-9);
  EXPECT_LT(with(false).k_g_rad_per_m, 1e-9);
  EXPECT_EQ(with(true).gaps, 1u);
  EXPECT_LT(with(true).d_ep_m, 1e-12);  // a gap counts as one step
}

TEST(Measures, FiltersAndJumps) {
  const Target grid(make_grid(20));
  std::vector<Vec3> line, back, half;
  for (int i = 0; i <= 40; ++i) line.push_back(Vec3(-0.8 + 0.04 * i, 0.1, 0.0));
  back.assign(line.rbegin(), line.rend());
  half.assign(line.begin(), line.begin() + 20);
  const TargetCurve intended{on(grid, line), {0, 10, 25, 40}, {}};
  const auto measured = [&](const std::vector<Vec3>& drawn) {
    return measure_on(grid, intended, draw(grid, on(grid, drawn), 1.0), 1.0);
  };
  EXPECT_TRUE(measured(line).filters.passed());
  EXPECT_TRUE(measured(back).filters.inverted);
  EXPECT_FALSE(measured(back).filters.too_short);
  EXPECT_TRUE(measured(half).filters.too_short);
  std::vector<Vec3> jump = line;
  jump[20].y() += 0.4;
  EXPECT_TRUE(measured(jump).filters.noisy);
  Drawing drawing = draw(grid, on(grid, jump), 1.0);
  for (std::size_t i = 0; i < line.size(); ++i) drawing.motion[i].pen = line[i];
  const Measures m = measure_on(grid, intended, drawing, 1.0);
  EXPECT_NEAR(m.largest_jump, std::hypot(0.4, 0.04) / 0.04, 1e-9);
  EXPECT_NEAR(m.share_jumping, 2.0 / 40.0, 1e-12);
}

TEST(Measures, RefuseWhatCannotBeMeasured) {
  const Target grid(make_grid(4));
  const std::vector<SurfacePoint> points = on(grid, std::vector<Vec3>{{0, 0, 0}, {0.5, 0, 0}});
  const auto message = [&](const Drawing& drawing, const TargetCurve& intended) -> std::string {
    try {
      measure_on(grid, intended, drawing, 1.0);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  const TargetCurve sound{points, {}, {}};
  Drawing drawing = draw(grid, points, 1.0);
  using testing::HasSubstr;
  EXPECT_THAT(message({}, sound), HasSubstr("empty"));
  EXPECT_THAT(message({drawing.curve, {}}, sound), HasSubstr("no frames"));
  EXPECT_THAT(message(drawing, {{points[0], points[0]}, {}, {}}), HasSubstr("no length"));
  EXPECT_THAT(message(drawing, {{{1000, {1, 0, 0}}}, {}, {}}), HasSubstr("32 faces"));
  EXPECT_THAT(message(drawing, {points, {7}, {}}), HasSubstr("keypoint 7"));
  drawing.motion[1].time_s = -1.0;
  EXPECT_THAT(message(drawing, sound), HasSubstr("runs backwards at frame 1"));
  drawing.motion[1].time_s = std::nan("");
  EXPECT_THAT(message(drawing, sound), HasSubstr("time of frame 1"));
}

TEST(Motion, ARotationSweepHasItsAngle) {
  std::vector<MotionSample> motion(200);
  const double sweep = 2.5;
  const Vec3 axis = Vec3(1, 2, 3).normalized();
  for (std::size_t i = 0; i < motion.size(); ++i) {
    const double a = sweep * static_cast<double>(i) / 199.0;
    const Eigen::AngleAxisd turn(a, axis);
    motion[i].time_s = static_cast<double>(i) / 90.0;
    motion[i].pen_forward = turn * -Vec3::UnitZ();
    motion[i].pen_up = turn * Vec3::UnitY();
    motion[i].pen = Vec3(a, 0, 0);
  }
  EXPECT_NEAR(motion_lengths(motion).pen_rad, sweep, 1e-9);
  EXPECT_NEAR(motion_lengths(motion).pen_m, sweep, 1e-9);
  EXPECT_EQ(motion_lengths(motion).head_rad, 0.0);
  // At its ends the filter sees one side only: it takes off less than its width.
  const MotionLengths smooth = motion_lengths(filtered(motion));
  const double width = 2.0 * kMotionCut_s * 90.0 / 199.0;
  EXPECT_LT(smooth.pen_rad, sweep);
  EXPECT_GT(smooth.pen_rad, sweep * (1.0 - width));
}

TEST(Motion, TheFilterAveragesWithinItsWindow) {
  std::vector<MotionSample> motion(3);
  motion[1].time_s = 0.02;
  motion[2].time_s = 0.08;  // beyond 50 ms of both
  motion[0].pen.x() = 1.0;
  motion[2].pen.x() = 5.0;
  const double w = std::exp(-0.5);
  const auto smooth = filtered(motion);
  ASSERT_EQ(smooth.size(), 3u);
  EXPECT_NEAR(smooth[0].pen.x(), 1.0 / (1.0 + w), 1e-15);
  EXPECT_NEAR(smooth[1].pen.x(), w / (1.0 + w), 1e-15);
  EXPECT_NEAR(smooth[2].pen.x(), 5.0, 1e-15);
}

TEST(Motion, OfEqualTimesTheLaterFrameCounts) {
  std::vector<MotionSample> motion(3);
  motion[2].time_s = 1.0;
  motion[0].pen.x() = 1.0;
  motion[1].pen.x() = 2.0;
  motion[2].pen.x() = 3.0;
  const auto smooth = filtered(motion);
  ASSERT_EQ(smooth.size(), 2u);
  EXPECT_EQ(smooth[0].pen.x(), 2.0);
}

TEST(Motion, UpStaysAndForwardIsMadeOrthogonal) {
  std::vector<MotionSample> motion(1);
  motion[0].pen_up = Vec3(0, 2, 0);
  motion[0].pen_forward = Vec3(0, 0.5, -1);
  const auto smooth = filtered(motion);
  EXPECT_LT((smooth[0].pen_up - Vec3::UnitY()).norm(), 1e-15);
  EXPECT_LT((smooth[0].pen_forward + Vec3::UnitZ()).norm(), 1e-15);
}

TEST(Consistency, IsTheMeanChangeWithoutOutliers) {
  const std::vector<double> first = {1.0, 2.0, 4.0, 0.0, std::nan("")};
  const std::vector<double> repeat = {1.5, 1.0, 4.0, 1.0, 1.0};
  const Consistency c = consistency(first, repeat);
  EXPECT_NEAR(c.mean_change, (0.5 + 0.5 + 0.0) / 3.0, 1e-15);
  EXPECT_EQ(c.used, 3u);
  EXPECT_EQ(c.undefined, 2u);
  EXPECT_EQ(c.dropped, 0u);
  std::vector<double> ones(100, 1.0), changed(100, 1.2);
  changed[50] = 1e6;
  const Consistency outlier = consistency(ones, changed);
  EXPECT_EQ(outlier.dropped, 1u);
  EXPECT_NEAR(outlier.mean_change, 0.2, 1e-9);
  EXPECT_EQ(consistency(ones, ones).dropped, 0u);
  EXPECT_TRUE(std::isnan(consistency({}, {}).mean_change));
}

TEST(FrameRate, AProjectionOfSinglePointsDependsOnItByTheChordsOnly) {
  Stroke stroke;
  for (int i = 0; i <= 90; ++i) {
    Frame frame;
    frame.time_s = i / 90.0;
    frame.controller.position = Vec3(std::cos(0.02 * i), std::sin(0.02 * i), 0.0);
    stroke.frames.push_back(frame);
  }
  const ProjectFunction pen = [](const Stroke& s) {
    std::vector<Vec3> points;
    for (const auto& f : s.frames) points.push_back(f.controller.position);
    return points;
  };
  const std::vector<int> divisors = {2, 3};
  const double off = frame_rate_dependence_m(stroke, pen, divisors);
  EXPECT_GT(off, 0.0);
  EXPECT_LT(off, 0.06 * 0.06 / 8.0);  // the sagitta of the longest chord
  // One that walks a fixed way for each frame loses all that is thinned out.
  const ProjectFunction counter = [](const Stroke& s) {
    return std::vector<Vec3>{Vec3::Zero(),
                             Vec3(0.001 * static_cast<double>(s.frames.size()), 0, 0)};
  };
  EXPECT_NEAR(frame_rate_dependence_m(stroke, counter, divisors), 0.5 * 0.001 * (91 - 31), 1e-12);
  EXPECT_EQ(thinned(stroke, 4).frames.size(), 24u);
  EXPECT_EQ(thinned(stroke, 4).frames.back().time_s, 1.0);
}

TEST(Frechet, SeesTheOrderThatClosestDistancesDoNot) {
  const std::vector<Vec3> there = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(2, 0, 0)};
  const std::vector<Vec3> back(there.rbegin(), there.rend());
  EXPECT_EQ(frechet_distance(there, there), 0.0);
  EXPECT_EQ(frechet_distance(there, back), 2.0);
  EXPECT_EQ(symmetric_distance(there, back), 0.0);
  // Worked by hand: a detour of 3 in the middle.
  const std::vector<Vec3> detour = {Vec3(0, 0, 0), Vec3(1, 3, 0), Vec3(2, 0, 0)};
  EXPECT_EQ(frechet_distance(there, detour), 3.0);
}

TEST(Inversions, CountPairsInTheWrongOrder) {
  std::vector<Vec3> line;
  for (int i = 0; i <= 10; ++i) line.push_back(Vec3(i, 0, 0));
  const auto count = [&](std::initializer_list<double> places) {
    std::vector<Vec3> keypoints;
    for (const double x : places) keypoints.push_back(Vec3(x, 1, 0));
    return inversions(line, keypoints);
  };
  EXPECT_EQ(count({0, 3, 7, 10}), 0u);
  EXPECT_EQ(count({10, 7, 3, 0}), 6u);
  EXPECT_EQ(count({3, 0, 7, 10}), 1u);
  EXPECT_EQ(count({3, 3}), 0u);
}

}  // namespace
}  // namespace mimicry
