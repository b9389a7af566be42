#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <mimicry/study/comparison.h>
#include <mimicry/study/measures.h>

#include "lab/pairing.h"
#include "lab/study_rows.h"

namespace mimicry::lab {

struct SummaryOptions {
  std::vector<std::string>
      methods;                 ///< to compare: the first with each other; empty: all there are
  bool keep_tutorial = false;  ///< the study's first shape counts too
  ComparisonOptions comparison;
};

/// 5 %, quartiles and 95 % (linear between order statistics) and the mean of one measure.
struct Box {
  std::string measure, method, group;
  std::size_t strokes = 0;
  double p5 = 0, q1 = 0, median = 0, q3 = 0, p95 = 0, mean = 0;
};

/// Least squares of log10 y on log10 x.
struct LogLine {
  double slope = 0, intercept = 0, correlation = 0;
};

struct ScatterPoint {
  double x = 0, y = 0;
  const StudyRow* stroke = nullptr;  ///< of the first method
};

struct ScatterPlot {
  std::string measure;
  std::vector<ScatterPoint> points;  ///< pairs of positive numbers
  std::optional<LogLine> line;       ///< of three points or more
};

/// Two methods, compared as `mimicry compare` does.
struct MethodPair {
  std::string a, b;
  std::vector<PairedGroup> groups;                   ///< tracing, re-creating, all
  std::vector<std::vector<Comparison>> comparisons;  ///< of each group
  std::vector<ScatterPlot> scatter;                  ///< K_E, K_g, F_g
};

/// How a method's curves jump; over its strokes that count.
struct JumpRate {
  std::string method;
  std::size_t strokes = 0;
  double jumping_strokes = 0;  ///< part of the strokes with a step above 5
  double jumping_steps = 0;    ///< mean part of steps above 5
  double median_largest = 0, largest = 0;
  double gaps = 0;  ///< mean number
};

/// What the paper reports of all strokes of a method.
struct FilterRate {
  std::string method;
  std::size_t strokes = 0;
  std::size_t too_short = 0, noisy = 0, inverted = 0, rejected = 0, passed = 0;
  double violation_below_25 = 0, violation_below_20 = 0;  ///< part of those that passed
  /// Change of D_ep and F_g from a stroke to its repeat, where both passed.
  Consistency d_ep, f_g;
};

/// All numbers of a report. Refers to the rows.
struct Summary {
  std::vector<std::string> methods, tasks, shapes, measures;
  std::size_t participants = 0;
  std::size_t simulated = 0;              ///< strokes that no person drew, of all that follow
  std::vector<std::string> simulated_by;  ///< programs with their versions and seeds
  std::size_t tutorial = 0;               ///< rows left out
  std::vector<const StudyRow*> counted;   ///< that passed the filters
  std::vector<const StudyRow*> failed;
  std::vector<MethodPair> pairs;
  std::vector<Box> by_task, by_shape;
  std::vector<JumpRate> jumps;  ///< empty where the rows do not say
  std::vector<FilterRate> filters;
};

/// Throws Error(invalid_input) where a method is not among the rows, or there are none to compare.
Summary summarise(const StudyRows& rows, const SummaryOptions& options);

}  // namespace mimicry::lab
