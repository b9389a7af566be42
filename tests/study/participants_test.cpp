#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <vector>

#include <gtest/gtest.h>

#include <mimicry/base/error.h>
#include <mimicry/mesh/shapes.h>
#include <mimicry/study/simulate.h>
#include <mimicry/study/targets.h>

namespace mimicry {
namespace {

TEST(Participants, SequenceIsThePapersProtocol) {
  const std::vector<Index> methods = {0, 1}, shapes = {0, 1, 2}, counts = {10, 10, 6};
  std::map<Index, int> first;
  std::vector<std::vector<Index>> seen;
  for (Index p = 0; p < 20; ++p) {
    const StudySequence s = study_sequence(methods, shapes, counts, 7, p);
    ++first[s.methods.front()];
    EXPECT_EQ(s.shapes, shapes);
    ASSERT_EQ(s.strokes.size(), 3u);
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t half = static_cast<std::size_t>(counts[k]) / 2;
      const std::vector<Index>& strokes = s.strokes[k];
      ASSERT_EQ(strokes.size(), 2 * half + 2);
      EXPECT_EQ(strokes[half], strokes[0]);
      EXPECT_EQ(strokes.back(), strokes[half + 1]);
      std::vector<Index> all = strokes;
      std::sort(all.begin(), all.end());
      all.erase(std::unique(all.begin(), all.end()), all.end());
      EXPECT_EQ(all.size(), 2 * half) << "every curve is drawn";
      const auto trials = s.trials(1, shapes[k]);
      EXPECT_EQ(trials[half].task, TaskKind::tracing);
      EXPECT_TRUE(trials[half].repeat);
      EXPECT_EQ(trials[half + 1].task, TaskKind::re_creating);
      EXPECT_FALSE(trials[half + 1].repeat);
    }
    seen.push_back(s.strokes[0]);
  }
  EXPECT_EQ(first[0], 10);
  EXPECT_EQ(first[1], 10);
  EXPECT_NE(seen[0], seen[1]) << "shuffled for each";
  EXPECT_THROW(study_sequence(methods, shapes, std::vector<Index>{10, 9, 10}, 1, 0), Error);
  EXPECT_THROW(study_sequence({}, shapes, counts, 1, 0), Error);
}

TEST(Participants, ThreeMethodsAreCounterbalanced) {
  const std::vector<Index> methods = {0, 1, 2}, shapes = {1}, counts = {10};
  std::map<std::pair<Index, std::size_t>, int> places;
  std::map<std::pair<Index, Index>, int> before;
  for (Index p = 0; p < 6; ++p) {
    const auto order = study_sequence(methods, shapes, counts, 1, p).methods;
    for (std::size_t i = 0; i < 3; ++i) {
      ++places[{order[i], i}];
      for (std::size_t j = i + 1; j < 3; ++j) ++before[{order[i], order[j]}];
    }
  }
  for (const auto& [place, count] : places) EXPECT_EQ(count, 2) << place.first;
  for (const auto& [pair, count] : before) EXPECT_EQ(count, 3) << pair.first << pair.second;
}

TEST(Participants, PeopleDifferAndStayThemselves) {
  const PopulationOptions options;
  std::vector<double> tremor;
  for (Index p = 0; p < 400; ++p) {
    const Participant person = participant(options, 3, p);
    EXPECT_EQ(person.hand.tremor_m, participant(options, 3, p).hand.tremor_m);
    tremor.push_back(std::log(person.hand.tremor_m / options.tremor_m.median) /
                     options.tremor_m.log_deviation);
  }
  // Standard normal: 400 of them, within 3 standard errors.
  const double mean = std::accumulate(tremor.begin(), tremor.end(), 0.0) / 400;
  double squares = 0;
  for (const double t : tremor) squares += (t - mean) * (t - mean);
  EXPECT_NEAR(mean, 0, 3 / 20.0);
  EXPECT_NEAR(std::sqrt(squares / 399), 1, 3 / 28.0);
}

struct ClosedLoopScene {
  Target target{make_shape("torus", {.resolution = 24})};
  Intention curve = intended_curves("torus", target)[1];
  Similarity place{Quat::Identity(), Vec3(0, 1.2, 0), find_shape("torus")->metres_per_unit};
};

TEST(Participants, RecalledCurvesMeetTheirKeypoints) {
  const ClosedLoopScene s;
  const auto count = static_cast<Index>(s.curve.points.size());
  const std::vector<Index> keypoints = {0, count / 3, count / 2, count - 1};
  const Intention meant = recalled(s.target, s.curve, keypoints, 0.02, 5);
  const auto off = [&](Index i) {
    const auto k = static_cast<std::size_t>(i);
    return (s.target.position(meant.points[k]) - s.target.position(s.curve.points[k])).norm();
  };
  double largest = 0;
  for (Index i = 0; i < count; ++i) largest = std::max(largest, off(i));
  for (const Index k : keypoints) EXPECT_EQ(off(k), 0) << k;
  EXPECT_GT(largest * s.place.scale, 0.5e-3);
  EXPECT_LT(largest * s.place.scale, 0.05);
  const auto exact = recalled(s.target, s.curve, keypoints, 0, 5);
  for (std::size_t i = 0; i < exact.points.size(); ++i)
    EXPECT_LT((s.target.position(exact.points[i]) - s.target.position(s.curve.points[i])).norm(),
              1e-9);
}

TEST(Participants, TrialsAreSeededAndDifferByTechniqueAndTask) {
  const ClosedLoopScene s;
  const PopulationOptions options;
  const Participant person = participant(options, 1, 0);
  const auto draw = [&](TaskKind task, Steering steering, std::uint64_t number) {
    return draw_trial(s.target, s.curve, {}, task, s.place, options, person, steering, number,
                      [](const Frame&) { return std::optional<Vec3>(); });
  };
  const Stroke a = draw(TaskKind::tracing, Steering::moves, 4);
  const Stroke b = draw(TaskKind::tracing, Steering::moves, 4);
  const Stroke c = draw(TaskKind::tracing, Steering::moves, 5);
  ASSERT_EQ(a.frames.size(), b.frames.size());
  EXPECT_EQ(a.frames.back().controller.position, b.frames.back().controller.position);
  EXPECT_NE(a.frames.back().controller.position, c.frames.back().controller.position);
  EXPECT_NO_THROW(require_usable(a));
  const Stroke aimed = draw(TaskKind::tracing, Steering::aims, 4);
  EXPECT_LT(aimed.frames.size(), a.frames.size()) << "aiming is quicker";
  const Stroke again = draw(TaskKind::re_creating, Steering::moves, 4);
  EXPECT_LT(again.frames.size(), a.frames.size());
  ASSERT_TRUE(again.intended);
  EXPECT_EQ(again.intended->points.size(), s.curve.points.size());
}

}  // namespace
}  // namespace mimicry
