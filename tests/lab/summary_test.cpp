#include "lab/summary.h"

#include <set>
#include <string>

#include <gtest/gtest.h>

#include <mimicry/base/error.h>

#include "lab/measured_rows.h"
#include "lab/report_data.h"

namespace mimicry::lab {
namespace {

StudyRows rows_of(const std::string& text) {
  return StudyRows(read_rows(text, "rows.csv"), "rows.csv");
}

// K_E of mimicry is the square of spraycan's, over 10.
std::string power_law(int strokes) {
  std::string text = "participant,method,shape,curve,task,K_E,D_ep_mm\n";
  for (int i = 1; i <= strokes; ++i)
    for (const bool mimicry : {false, true})
      text += std::string("p,") + (mimicry ? "mimicry" : "spraycan") + ",hand," +
              std::to_string(i) + ",tracing," + std::to_string(mimicry ? i * i / 10.0 : 1.0 * i) +
              "," + std::to_string(i) + "\n";
  return text;
}

TEST(Summary, BoxesAreQuantilesBetweenOrderStatistics) {
  const StudyRows rows = rows_of(power_law(5));
  const Summary summary = summarise(rows, {});
  ASSERT_FALSE(summary.by_task.empty());
  const Box& box = summary.by_task.front();
  EXPECT_EQ(box.measure, "D_ep_mm");
  EXPECT_EQ(box.method, "spraycan");
  EXPECT_EQ(box.group, "tracing");
  EXPECT_EQ(box.strokes, 5u);
  EXPECT_DOUBLE_EQ(box.p5, 1.2);
  EXPECT_DOUBLE_EQ(box.q1, 2);
  EXPECT_DOUBLE_EQ(box.median, 3);
  EXPECT_DOUBLE_EQ(box.q3, 4);
  EXPECT_DOUBLE_EQ(box.p95, 4.8);
  EXPECT_DOUBLE_EQ(box.mean, 3);
}

TEST(Summary, TheLineOfAScatterPlotIsLeastSquaresOfLogarithms) {
  const StudyRows rows = rows_of(power_law(20));
  const Summary summary = summarise(rows, {});
  ASSERT_EQ(summary.pairs.size(), 1u);
  ASSERT_EQ(summary.pairs[0].scatter.size(), 1u);
  const ScatterPlot& plot = summary.pairs[0].scatter[0];
  EXPECT_EQ(plot.measure, "K_E");
  EXPECT_EQ(plot.points.size(), 20u);
  ASSERT_TRUE(plot.line);
  EXPECT_NEAR(plot.line->slope, 2, 1e-5);
  EXPECT_NEAR(plot.line->intercept, -1, 1e-5);
  EXPECT_NEAR(plot.line->correlation, 1, 1e-9);
}

TEST(Summary, TheTutorialDoesNotCountUnlessAsked) {
  const StudyRows rows = rows_of(power_law(4) + "p,mimicry,torus,1,tracing,9,9\n");
  EXPECT_EQ(summarise(rows, {}).tutorial, 1u);
  SummaryOptions options;
  options.keep_tutorial = true;
  EXPECT_EQ(summarise(rows, options).tutorial, 0u);
  options.methods = {"snap"};
  EXPECT_THROW(summarise(rows, options), Error);
}

TEST(Picks, WorstAndBestOfEachMethodAndNoStrokeTwice) {
  const StudyRows rows = rows_of(power_law(5));
  const Summary summary = summarise(rows, {});
  const auto picks = pick_strokes(rows, summary, "D_ep_mm", 3);
  ASSERT_EQ(picks.size(), 10u);
  std::set<const StudyRow*> seen;
  std::vector<double> values;
  for (const StrokePick& pick : picks) {
    EXPECT_TRUE(seen.insert(pick.row).second);
    values.push_back(pick.value);
  }
  EXPECT_EQ(values, (std::vector<double>{5, 4, 3, 1, 2, 5, 4, 3, 1, 2}));
  EXPECT_FALSE(picks[2].best);
  EXPECT_TRUE(picks[3].best);
  EXPECT_TRUE(pick_strokes(rows, summary, "D_ep_mm", 0).empty());
}

TEST(ReportData, ColoursComeFromTheCaller) {
  const StudyRows rows = rows_of(power_law(5));
  const std::string data = figure_data(summarise(rows, {}), [](const std::string& method) {
    return "#" + std::to_string(method.size());
  });
  EXPECT_NE(data.find("{\"name\":\"spraycan\",\"color\":\"#8\"}"), std::string::npos);
  EXPECT_EQ(data.find('\n'), std::string::npos);
}

}  // namespace
}  // namespace mimicry::lab
