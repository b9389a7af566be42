#include <cmath>

#include <mimicry/study/comparison.h>

namespace mimicry {
namespace {

bool is_near(double ours, double paper) {
  return std::isfinite(ours) && std::abs(ours - paper) <= kMeanTolerance * std::abs(paper);
}

}  // namespace

const std::array<PaperRow, 10>& paper_table() {
  static constexpr std::array<PaperRow, 10> kTable = {{
      {"D_ep_mm",
       {2.31, 2.64, 1.13, 1.11, 8.36, "<.001", true},
       {2.34, 2.49, 2.24, 23.32, 8.63, "<.001", true}},
      {"D_sym_mm",
       {0.64, 0.66, 0.56, 0.44, -0.09, ">.05", false},
       {0.75, 0.65, 1.12, 11.51, 0.55, ">.05", false}},
      {"K_E",
       {280, 262, 174, 162, 15.59, "<.001", true},
       {254, 236, 155, 127, 14.70, "<.001", true}},
      {"K_g",
       {249, 245, 152, 157, 15.42, "<.001", true},
       {223, 219, 132, 123, 14.95, "<.001", true}},
      {"F_g",
       {394, 413, 248, 285, 14.82, "<.001", true},
       {348, 371, 215, 227, 14.11, "<.001", true}},
      {"T_h",
       {0.81, 0.70, 0.58, 0.40, 7.93, "<.001", true},
       {0.72, 0.54, 0.54, 0.35, 6.78, "<.001", true}},
      {"R_h",
       {1.63, 2.18, 1.18, 1.63, 4.82, "<.001", true},
       {1.50, 2.19, 1.32, 1.99, 3.07, ".002", true}},
      {"T_c",
       {1.05, 0.36, 1.10, 0.29, -3.36, "<.001", true},
       {1.05, 0.37, 1.11, 0.23, -5.94, "<.001", true}},
      {"R_c",
       {5.12, 5.88, 3.79, 4.84, 5.51, "<.001", true},
       {5.23, 6.36, 3.63, 5.13, 4.00, "<.001", true}},
      {"tau_s",
       {4.69, 1.85, 5.29, 2.17, -7.32, "<.001", true},
       {4.33, 1.57, 4.92, 1.89, -7.12, "<.001", true}},
  }};
  return kTable;
}

const PaperFigure* paper_figure(std::string_view measure, TaskKind task) {
  for (const PaperRow& row : paper_table())
    if (row.measure == measure) return task == TaskKind::tracing ? &row.tracing : &row.re_creating;
  return nullptr;
}

Agreement agreement(const Comparison& ours, const PaperFigure& paper) {
  Agreement result;
  if (ours.pairs == 0) return result;
  result.spraycan_mean = is_near(ours.a.mean, paper.spraycan);
  result.mimicry_mean = is_near(ours.b.mean, paper.mimicry);
  result.sign = paper.z > 0 ? ours.test.z > 0 : ours.test.z < 0;
  result.significance = (ours.test.p() < kSignificance) == paper.significant;
  return result;
}

}  // namespace mimicry
