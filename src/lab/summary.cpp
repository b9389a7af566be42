#include "lab/summary.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include <mimicry/base/error.h>
#include <mimicry/study/recording.h>
#include <mimicry/technique/technique.h>

#include "base/comma_list.h"
#include "lab/columns.h"

namespace mimicry::lab {
namespace {

constexpr double kUndefined = std::numeric_limits<double>::quiet_NaN();
constexpr std::string_view kSmoothness[] = {column::kEuclideanCurvature, column::kGeodesicCurvature,
                                            column::kFairness};

bool contains(const std::vector<std::string>& list, const std::string& name) {
  return std::find(list.begin(), list.end(), name) != list.end();
}

void add_once(std::vector<std::string>& list, const std::string& name) {
  if (!name.empty() && !contains(list, name)) list.push_back(name);
}

// Spraycan, the paper's baseline, first, then as techniques are listed, then as they come.
std::vector<std::string> ordered_methods(const StudyRows& rows) {
  std::vector<std::string> there, order;
  for (const StudyRow& row : rows.rows()) add_once(there, row.method);
  if (contains(there, "spraycan")) order.push_back("spraycan");
  for (const TechniqueInfo& info : techniques())
    if (contains(there, info.name)) add_once(order, info.name);
  for (const std::string& name : there) add_once(order, name);
  return order;
}

std::vector<std::string> chosen_methods(const StudyRows& rows,
                                        const std::vector<std::string>& wanted) {
  const std::vector<std::string> there = ordered_methods(rows);
  if (wanted.empty()) return there;
  std::vector<std::string> chosen;
  for (const std::string& name : wanted) {
    if (!contains(there, name))
      throw Error(ErrorKind::invalid_input, "--methods: " + rows.file() + " has no row of '" +
                                                name + "', only of " + comma_list(there));
    add_once(chosen, name);
  }
  return chosen;
}

// Of sorted values.
double quantile(const std::vector<double>& sorted, double part) {
  const double at = part * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(at);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return sorted[below] + (at - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

std::optional<Box> box_of(std::vector<double> values) {
  std::erase_if(values, [](double v) { return !std::isfinite(v); });
  if (values.empty()) return std::nullopt;
  std::sort(values.begin(), values.end());
  Box box;
  box.strokes = values.size();
  box.p5 = quantile(values, 0.05);
  box.q1 = quantile(values, 0.25);
  box.median = quantile(values, 0.5);
  box.q3 = quantile(values, 0.75);
  box.p95 = quantile(values, 0.95);
  box.mean = mean(values);
  return box;
}

std::vector<Box> boxes(const StudyRows& rows, const Summary& summary,
                       const std::vector<std::string>& groups, std::string StudyRow::*group_of) {
  std::vector<Box> all;
  for (const std::string& measure : summary.measures)
    for (const std::string& method : summary.methods)
      for (const std::string& group : groups) {
        std::vector<double> values;
        for (const StudyRow* row : summary.counted)
          if (row->method == method && (row->*group_of == group || group == kAllRows))
            values.push_back(rows.number(*row, measure));
        if (auto box = box_of(std::move(values))) {
          box->measure = measure;
          box->method = method;
          box->group = group;
          all.push_back(*box);
        }
      }
  return all;
}

std::optional<LogLine> log_line(const std::vector<ScatterPoint>& points) {
  if (points.size() < 3) return std::nullopt;
  const auto n = static_cast<double>(points.size());
  double mx = 0, my = 0;
  for (const ScatterPoint& p : points) {
    mx += std::log10(p.x) / n;
    my += std::log10(p.y) / n;
  }
  double xx = 0, xy = 0, yy = 0;
  for (const ScatterPoint& p : points) {
    const double x = std::log10(p.x) - mx, y = std::log10(p.y) - my;
    xx += x * x;
    xy += x * y;
    yy += y * y;
  }
  if (!(xx > 0) || !(yy > 0)) return std::nullopt;
  const double slope = xy / xx;
  return LogLine{slope, my - slope * mx, xy / std::sqrt(xx * yy)};
}

ScatterPlot scatter_plot(const StudyRows& rows, const PairedGroup& all, std::string_view measure) {
  ScatterPlot plot;
  plot.measure = measure;
  for (const auto& [a, b] : all.rows) {
    const StudyRow& first = rows.rows()[a];
    const double x = rows.number(first, measure), y = rows.number(rows.rows()[b], measure);
    if (std::isfinite(x) && std::isfinite(y) && x > 0 && y > 0)
      plot.points.push_back({x, y, &first});
  }
  plot.line = log_line(plot.points);
  return plot;
}

MethodPair compare_pair(const StudyRows& rows, const Summary& summary, const std::string& b,
                        const std::vector<std::string>& without, const ComparisonOptions& options) {
  MethodPair pair;
  pair.a = summary.methods.front();
  pair.b = b;
  PairingOptions pairing;
  pairing.method_a = pair.a;
  pairing.method_b = pair.b;
  pairing.without = without;
  pair.groups = pair_rows(rows.table(), pairing, rows.file());
  // The paper's order: tracing comes first.
  std::stable_partition(pair.groups.begin(), pair.groups.end(), [](const PairedGroup& group) {
    return group.name == group_name(column::kTask, task_name(TaskKind::tracing));
  });
  for (const PairedGroup& group : pair.groups)
    pair.comparisons.push_back(compare(group.measures, options));
  for (const std::string_view measure : kSmoothness)
    if (rows.has(measure)) pair.scatter.push_back(scatter_plot(rows, pair.groups.back(), measure));
  std::erase_if(pair.scatter, [](const ScatterPlot& plot) { return plot.points.empty(); });
  return pair;
}

JumpRate jump_rate(const StudyRows& rows, const Summary& summary, const std::string& method) {
  JumpRate rate;
  rate.method = method;
  std::vector<double> largest, shares, gaps;
  for (const StudyRow* row : summary.counted) {
    if (row->method != method) continue;
    ++rate.strokes;
    const auto add = [&](std::vector<double>& list, std::string_view column) {
      const double value = rows.number(*row, column);
      if (std::isfinite(value)) list.push_back(value);
    };
    add(largest, column::kLargestJump);
    add(shares, column::kShareJumping);
    add(gaps, column::kGaps);
  }
  const auto jumping = std::count_if(shares.begin(), shares.end(), [](double s) { return s > 0; });
  rate.jumping_strokes = shares.empty()
                             ? kUndefined
                             : static_cast<double>(jumping) / static_cast<double>(shares.size());
  rate.jumping_steps = mean(shares);
  rate.median_largest = median(largest);
  rate.largest = largest.empty() ? kUndefined : *std::max_element(largest.begin(), largest.end());
  rate.gaps = mean(gaps);
  return rate;
}

Consistency consistency_of(const StudyRows& rows, const Summary& summary, const std::string& method,
                           std::string_view measure) {
  std::map<std::vector<std::string>, std::pair<const StudyRow*, const StudyRow*>> tasks;
  for (const StudyRow* row : summary.counted) {
    if (row->method != method || row->repetition.empty()) continue;
    auto& [first, again] = tasks[{row->participant, row->shape, row->task, row->curve}];
    (row->repetition == "0" ? first : again) = row;
  }
  std::vector<double> first, again;
  for (const auto& [task, pair] : tasks) {
    if (pair.first == nullptr || pair.second == nullptr) continue;
    first.push_back(rows.number(*pair.first, measure));
    again.push_back(rows.number(*pair.second, measure));
  }
  return consistency(first, again);
}

FilterRate filter_rate(const StudyRows& rows, const Summary& summary,
                       const std::vector<const StudyRow*>& all, const std::string& method) {
  FilterRate rate;
  rate.method = method;
  std::size_t below_25 = 0, below_20 = 0;
  for (const StudyRow* row : all) {
    if (row->method != method) continue;
    // A cell without a number compares with nothing.
    const auto value = [&](std::string_view column) {
      const double number = rows.number(*row, column);
      return std::isfinite(number) ? std::optional(number) : std::nullopt;
    };
    const bool too_short = value(column::kShort) > 0, noisy = value(column::kNoisy) > 0,
               inverted = value(column::kInverted) > 0;
    ++rate.strokes;
    rate.too_short += too_short ? 1 : 0;
    rate.noisy += noisy ? 1 : 0;
    rate.inverted += inverted ? 1 : 0;
    if (row->failed.empty()) {
      ++rate.passed;
      if (const auto violation = value(column::kViolation)) {
        below_25 += *violation < 0.25 ? 1 : 0;
        below_20 += *violation < 0.20 ? 1 : 0;
      }
    } else if (!too_short && !noisy && !inverted) {
      ++rate.rejected;
    }
  }
  const auto passed = static_cast<double>(rate.passed);
  const bool known = rows.has(column::kViolation) && rate.passed > 0;
  rate.violation_below_25 = known ? static_cast<double>(below_25) / passed : kUndefined;
  rate.violation_below_20 = known ? static_cast<double>(below_20) / passed : kUndefined;
  rate.d_ep = consistency_of(rows, summary, method, column::kDistance);
  rate.f_g = consistency_of(rows, summary, method, column::kFairness);
  return rate;
}

}  // namespace

Summary summarise(const StudyRows& rows, const SummaryOptions& options) {
  Summary summary;
  summary.methods = chosen_methods(rows, options.methods);
  for (const PaperMeasure& measure : paper_measures())
    if (rows.has(measure.column)) summary.measures.emplace_back(measure.column);
  if (summary.measures.empty())
    throw Error(ErrorKind::invalid_input,
                rows.file() +
                    ": has none of the paper's measures (D_ep_mm, K_E, ...); write it "
                    "with mimicry measure or replay");

  const std::string tutorial(kStudyShapes[kTutorialShape]);
  const auto is_tutorial = [&](const StudyRow& row) {
    return !options.keep_tutorial && !row.participant.empty() && !row.task.empty() &&
           row.shape == tutorial;
  };
  std::set<std::string> participants;
  bool has_tutorial = false;
  std::vector<const StudyRow*> all;
  for (const StudyRow& row : rows.rows()) {
    if (!contains(summary.methods, row.method)) continue;
    if (is_tutorial(row)) {
      ++summary.tutorial;
      has_tutorial = true;
      continue;
    }
    all.push_back(&row);
    (row.failed.empty() ? summary.counted : summary.failed).push_back(&row);
    if (!row.participant.empty()) participants.insert(row.participant);
    add_once(summary.tasks, row.task);
    if (!row.simulated.empty()) ++summary.simulated;
    add_once(summary.simulated_by, row.simulated);
  }
  if (all.empty())
    throw Error(ErrorKind::invalid_input, rows.file() + ": has only strokes of the tutorial, " +
                                              tutorial + "; count them with --keep-tutorial");
  std::stable_partition(summary.tasks.begin(), summary.tasks.end(), [](const std::string& task) {
    return task == task_name(TaskKind::tracing);
  });
  for (const std::string_view shape : kStudyShapes)
    for (const StudyRow* row : all)
      if (row->shape == shape) add_once(summary.shapes, row->shape);
  for (const StudyRow* row : all) add_once(summary.shapes, row->shape);
  summary.participants = participants.size();

  std::vector<std::string> without;
  if (has_tutorial) without.push_back(std::string(column::kShape) + "=" + tutorial);
  for (std::size_t i = 1; i < summary.methods.size(); ++i)
    summary.pairs.push_back(
        compare_pair(rows, summary, summary.methods[i], without, options.comparison));

  if (summary.tasks.empty()) summary.tasks.emplace_back(kAllRows);
  summary.by_task = boxes(rows, summary, summary.tasks, &StudyRow::task);
  summary.by_shape = boxes(rows, summary, summary.shapes, &StudyRow::shape);
  for (const std::string& method : summary.methods) {
    if (rows.has(column::kLargestJump)) summary.jumps.push_back(jump_rate(rows, summary, method));
    summary.filters.push_back(filter_rate(rows, summary, all, method));
  }
  return summary;
}

}  // namespace mimicry::lab
