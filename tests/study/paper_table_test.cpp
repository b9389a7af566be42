#include <cmath>
#include <limits>
#include <set>
#include <string_view>

#include <gtest/gtest.h>

#include <mimicry/study/comparison.h>

namespace mimicry {
namespace {

constexpr PaperFigure kDifferent = {2.0, 1, 4.0, 1, -5, "<.001", true};
constexpr PaperFigure kAlike = {2.0, 1, 2.0, 1, -0.1, ">.05", false};

Comparison measured(double a, double b, double z, double p) {
  Comparison comparison;
  comparison.pairs = 100;
  comparison.a.mean = a;
  comparison.b.mean = b;
  comparison.test.z = z;
  comparison.test.p_normal = p;
  return comparison;
}

TEST(PaperTable, HasEachMeasureOnceForBothTasks) {
  std::set<std::string_view> names;
  for (const PaperRow& row : paper_table()) {
    names.insert(row.measure);
    for (const TaskKind task : {TaskKind::tracing, TaskKind::re_creating}) {
      const PaperFigure* figure = paper_figure(row.measure, task);
      ASSERT_NE(figure, nullptr);
      EXPECT_EQ(figure->significant, figure->p != ">.05") << row.measure;
      // 1.96 deviations are p = .05.
      EXPECT_EQ(figure->significant, std::abs(figure->z) > 1.96) << row.measure;
    }
  }
  EXPECT_EQ(names.size(), 10U);
  EXPECT_EQ(paper_figure("R_h", TaskKind::re_creating)->z, 3.07);
  EXPECT_EQ(paper_figure("frechet_mm", TaskKind::tracing), nullptr);
}

TEST(Agreement, MeansWithinAQuarterOfThePapers) {
  const auto with_mean = [](double a) { return agreement(measured(a, 4, -5, 0), kDifferent); };
  EXPECT_TRUE(with_mean(1.5).spraycan_mean);
  EXPECT_TRUE(with_mean(2.5).spraycan_mean);
  EXPECT_FALSE(with_mean(1.49).spraycan_mean);
  EXPECT_FALSE(with_mean(2.51).spraycan_mean);
  EXPECT_FALSE(with_mean(2.51).means());
  EXPECT_TRUE(with_mean(2.51).mimicry_mean);
  EXPECT_FALSE(with_mean(std::numeric_limits<double>::quiet_NaN()).spraycan_mean);
}

TEST(Agreement, DifferencesBySignAndSignificance) {
  const auto difference = [](double z, double p, const PaperFigure& paper) {
    return agreement(measured(2, 4, z, p), paper).difference(paper);
  };
  EXPECT_TRUE(difference(-2, 0.049, kDifferent));
  EXPECT_FALSE(difference(-2, 0.05, kDifferent));
  EXPECT_FALSE(difference(2, 0.01, kDifferent));
  EXPECT_FALSE(difference(0, 0.01, kDifferent));
  // No difference found: which way it is not there does not matter.
  EXPECT_TRUE(difference(-1, 0.3, kAlike));
  EXPECT_TRUE(difference(1, 0.3, kAlike));
  EXPECT_FALSE(difference(-3, 0.01, kAlike));
}

TEST(Agreement, NothingAgreesWithoutPairs) {
  Comparison none = measured(2, 2, 0, 1);
  none.pairs = 0;
  EXPECT_FALSE(agreement(none, kAlike).means());
  EXPECT_FALSE(agreement(none, kAlike).difference(kAlike));
}

}  // namespace
}  // namespace mimicry
