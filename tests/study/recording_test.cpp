#include <cmath>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <mimicry/base/error.h>
#include <mimicry/mesh/shapes.h>
#include <mimicry/session/stroke_session.h>
#include <mimicry/study/measures.h>
#include <mimicry/study/recording.h>
#include <mimicry/study/simulate.h>
#include <mimicry/study/targets.h>

namespace mimicry {
namespace {

struct Recorded {
  Target target{make_shape("torus", {.resolution = 24})};
  Stroke stroke;
  ProjectedCurve curve;
};

Recorded recorded(const char* technique, MissPolicy misses) {
  Recorded r;
  Similarity placed;
  placed.rotation = Quat(Eigen::AngleAxisd(0.4, Vec3(1, 1, 0).normalized()));
  placed.translation = Vec3(0.2, 1.2, -0.5);
  placed.scale = 0.3;
  SimulationOptions options;
  options.rate_hz = 30;
  options.wobble_rad = 0.6;  // so that spraycan misses the torus now and then
  r.stroke = simulate(r.target, intended_curves("torus", r.target)[1], placed, options, 3);
  SessionOptions session;
  session.misses = misses;
  r.curve = project({r.target}, find_technique(technique), r.stroke, session).curve;
  return r;
}

TEST(Recording, GivesStrokeAndCurveBack) {
  for (const char* technique : {"spraycan", "mimicry-live"}) {
    SCOPED_TRACE(technique);
    const Recorded r = recorded(technique, MissPolicy::split);
    const RecordedStroke file = record(r.stroke, r.curve, "Spray");
    EXPECT_EQ(frame_count(file), r.curve.points.size());
    EXPECT_EQ(method_of(file), "Spray");
    const ProjectedCurve curve = curve_of(file, r.target);
    ASSERT_EQ(curve.points.size(), r.curve.points.size());
    ASSERT_EQ(curve.pieces.size(), r.curve.pieces.size());
    const Stroke stroke = stroke_of(file);
    ASSERT_EQ(stroke.frames.size(), curve.points.size());
    for (std::size_t i = 0; i < curve.points.size(); ++i) {
      const CurvePoint& was = r.curve.points[i];
      EXPECT_EQ(curve.points[i].surface.face, was.surface.face);
      EXPECT_EQ(curve.points[i].surface.bary, was.surface.bary);
      EXPECT_EQ(curve.points[i].normal, was.normal);
      EXPECT_EQ(curve.points[i].pen_distance, was.pen_distance);
      const Frame& frame = r.stroke.frames[static_cast<std::size_t>(was.frame)];
      // The way into the model's coordinates and back rounds.
      EXPECT_NEAR(stroke.frames[i].time_s, frame.time_s, 1e-12);
      EXPECT_LT((stroke.frames[i].controller.position - frame.controller.position).norm(), 1e-12);
      EXPECT_LT((stroke.frames[i].head.position - frame.head.position).norm(), 1e-12);
      EXPECT_LT(
          stroke.frames[i].controller.orientation.angularDistance(frame.controller.orientation),
          1e-7);
    }
    for (std::size_t i = 0; i < curve.pieces.size(); ++i) {
      EXPECT_EQ(curve.pieces[i].kind, r.curve.pieces[i].kind) << i;
      EXPECT_EQ(curve.pieces[i].length, r.curve.pieces[i].length) << i;
    }
    std::size_t gaps = 0;
    for (const Piece& piece : curve.pieces) gaps += piece.kind == PieceKind::gap ? 1 : 0;
    EXPECT_EQ(piece_count(file), gaps + 1);
    // A recording of the recording is the recording.
    const RecordedStroke again = record(stroke, curve, "Spray");
    ASSERT_EQ(again.pieces.size(), file.pieces.size());
    EXPECT_LT((again.pieces[0].frames[0].pen - file.pieces[0].frames[0].pen).norm(), 1e-12);
  }
}

TEST(Recording, IsMeasuredLikeTheStrokeItself) {
  const Recorded r = recorded("mimicry-live", MissPolicy::connect);
  const TargetCurve target{r.stroke.intended->points, {}, {}};
  const RecordedStroke file = record(r.stroke, r.curve, "AnchorPhong");
  const IntendedCurve intended = intended_curve(r.target.mesh(), target, placement_of(file).scale);
  const auto measured = [&](const ProjectedCurve& curve, const std::vector<MotionSample>& motion) {
    return measure(r.target.surface(), intended, curve, motion);
  };
  // Every frame inked, so that both know the same.
  ASSERT_EQ(r.curve.points.size(), r.stroke.frames.size());
  const Measures a = measured(r.curve, motion_of(r.stroke));
  const Measures b = measured(curve_of(file, r.target), motion_of(file));
  EXPECT_NEAR(a.d_ep_m, b.d_ep_m, 1e-12);
  EXPECT_NEAR(a.k_g_rad_per_m, b.k_g_rad_per_m, 1e-9);
  EXPECT_NEAR(a.t_c, b.t_c, 1e-9);
  EXPECT_NEAR(a.r_h_rad_per_m, b.r_h_rad_per_m, 1e-9);
  EXPECT_NEAR(a.tau_s, b.tau_s, 1e-12);
  EXPECT_NEAR(a.largest_jump, b.largest_jump, 1e-9 * a.largest_jump);
  EXPECT_NEAR(a.mimicry_violation, b.mimicry_violation, 1e-12);
}

TEST(Recording, RefusalsNameTheReason) {
  const Recorded r = recorded("mimicry-live", MissPolicy::connect);
  const RecordedStroke sound = record(r.stroke, r.curve, "AnchorPhong");
  const auto message = [&](const RecordedStroke& stroke) -> std::string {
    try {
      method_of(stroke);
      motion_of(stroke);
      curve_of(stroke, r.target);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(message(sound), "");
  using testing::HasSubstr;
  EXPECT_THAT(message({}), HasSubstr("empty"));
  RecordedStroke bad = sound;
  bad.problem = "torn";
  EXPECT_EQ(message(bad), "torn");
  bad = sound;
  bad.pieces[0].frames[3].surface.face = 100000;
  EXPECT_THAT(message(bad), HasSubstr("faces; it is not the mesh that was drawn on"));
  bad = sound;
  bad.pieces[0].frames[3].surface.bary = Vec3(0.5, 0.5, 0.5);
  EXPECT_THAT(message(bad), HasSubstr("frame 3: B is not"));
  bad = sound;
  bad.pieces[0].frames[3].time_ms = std::nan("");
  EXPECT_THAT(message(bad), HasSubstr("frame 3: the time"));
  bad = sound;
  bad.pieces[0].model_to_world(0, 0) = std::nan("");
  EXPECT_THAT(message(bad), HasSubstr("not finite"));
  bad = sound;
  bad.pieces[0].model_to_world.row(0) *= -1.0;
  EXPECT_THAT(message(bad), HasSubstr("mirrors"));
  bad = sound;
  bad.pieces.push_back(bad.pieces[0]);
  bad.pieces[1].method = "Spray";
  EXPECT_THAT(message(bad), HasSubstr("different methods"));
  bad.pieces[1].frames.clear();
  EXPECT_EQ(message(bad), "");
}

TEST(Protocol, TrialsOfTheStudy) {
  const StudySequence sequence{{1, 0}, {0, 2}, {{3, 1, 3, 4, 0, 4}, {0, 1, 0, 2, 3, 2}}};
  const std::vector<Trial> trials = sequence.trials(0, 2);
  ASSERT_EQ(trials.size(), 6u);
  EXPECT_EQ(trials[1].curve, 1);
  EXPECT_FALSE(trials[0].repeat);
  EXPECT_TRUE(trials[2].repeat);
  EXPECT_EQ(trials[2].task, TaskKind::tracing);
  EXPECT_EQ(trials[3].task, TaskKind::re_creating);
  EXPECT_FALSE(trials[3].repeat);
  EXPECT_TRUE(trials[5].repeat);
  EXPECT_TRUE(sequence.trials(2, 2).empty());
  EXPECT_TRUE(sequence.trials(0, 1).empty());
  const StudySequence by_method{{1, 0}, {0}, {{1, 2, 1, 3, 4, 3}, {4, 3, 4, 2, 1, 2}}};
  EXPECT_EQ(by_method.trials(0, 0)[0].curve, 4);
}

TEST(Protocol, RepeatsAreAddedOrKept) {
  using testing::ElementsAre;
  EXPECT_THAT(with_repeats(std::vector<Index>{4, 2, 0, 1}), ElementsAre(4, 2, 4, 0, 1, 0));
  EXPECT_THAT(with_repeats(std::vector<Index>{4, 2, 4, 0, 1, 0}), ElementsAre(4, 2, 4, 0, 1, 0));
  EXPECT_TRUE(with_repeats(std::vector<Index>{4, 2, 2, 0, 1, 0}).empty());
  EXPECT_TRUE(with_repeats(std::vector<Index>{4, 2, 4, 4, 1, 4}).empty());
  EXPECT_TRUE(with_repeats(std::vector<Index>{1, 2, 3}).empty());
  EXPECT_TRUE(with_repeats({}).empty());
}

TEST(Protocol, MethodsHaveTheWordsOfTheRecordings) {
  EXPECT_EQ(method_word(kSpraycan), "Spray");
  EXPECT_EQ(method_number("AnchorPhong"), kMimicry);
  EXPECT_EQ(method_number("mimicry-live"), kNone);
  EXPECT_EQ(method_word(7), "");
}

}  // namespace
}  // namespace mimicry
