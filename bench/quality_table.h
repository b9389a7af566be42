#pragma once

#include <optional>
#include <string>
#include <vector>

#include <mimicry/base/parallel.h>
#include <mimicry/mesh/triangle_mesh.h>
#include <mimicry/stroke/stroke.h>

namespace mimicry::bench {

/// A shape to draw on, with the curves that are meant.
struct QualityShape {
  std::string name;
  TriangleMesh mesh;
  double metres_per_unit = 1.0;
  std::vector<Intention> curves;
};

/// What is varied. Every combination is drawn with every technique.
struct QualityPlan {
  std::vector<std::string> noises = {"low", "usual", "high"};  ///< of hand and tracking
  std::vector<bool> closed_loops = {false, true};
  std::vector<double> rates_hz = {30, 90, 240};
  int seeds = 5;
};

/// Means over shapes and curves; `spread` is their standard deviation from seed to seed.
struct QualityNumber {
  double mean = 0, spread = 0;
};

struct QualityRow {
  std::string technique, noise, loop;  ///< loop: "open" or "closed"
  double rate_hz = 0;
  QualityNumber d_ep_mm, d_sym_mm, k_g, jumps, length_ratio, failed;

  /// What says which row it is.
  std::string key() const;
};

/// Strokes over the shapes, projected and measured (study/measures.h). jumps: per cent of the steps
/// that are more than five times as long as the hand's; failed: per cent of strokes without a curve
/// or measure. Same plan, same bits, whatever the number of threads.
std::vector<QualityRow> quality_table(const std::vector<QualityShape>& shapes,
                                      const QualityPlan& plan, Executor& executor);

/// The part that the regression test runs: two built-in shapes, coarse.
std::vector<QualityShape> small_quality_shapes();
QualityPlan small_quality_plan();

std::string write_quality(const std::vector<QualityRow>& rows);
std::vector<QualityRow> read_quality(const std::string& csv);

/// Why a row is worse than the stored one: a number that is higher by more than the stored spread
/// (length_ratio: farther from 1). Empty where it is not.
std::string worse(const QualityRow& row, const QualityRow& stored);

}  // namespace mimicry::bench
