#include "cli/report/summary.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include <mimicry/base/error.h>
#include <mimicry/render/palette.h>
#include <mimicry/study/protocol.h>

namespace mimicry::cli {
namespace {

constexpr double kUndefined = std::numeric_limits<double>::quiet_NaN();
constexpr const char* kSmoothness[] = {"K_E", "K_g", "F_g"};

bool contains(const std::vector<std::string>& list, const std::string& name) {
  return std::find(list.begin(), list.end(), name) != list.end();
}

void add_once(std::vector<std::string>& list, const std::string& name) {
  if (!name.empty() && !contains(list, name)) list.push_back(name);
}

// Spraycan, the paper's baseline, first, then as in the palette, then as they come.
std::vector<std::string> ordered_methods(const StudyRows& rows) {
  std::vector<std::string> there, order;
  for (const StudyRow& row : rows.rows()) add_once(there, row.method);
  if (contains(there, "spraycan")) order.push_back("spraycan");
  for (const render::PaletteEntry& entry : render::technique_colors())
    if (contains(there, std::string(entry.name))) add_once(order, std::string(entry.name));
  for (const std::string& name : there) add_once(order, name);
  return order;
}

std::vector<std::string> chosen_methods(const StudyRows& rows,
                                        const std::vector<std::string>& wanted) {
  const std::vector<std::string> there = ordered_methods(rows);
  if (wanted.empty()) return there;
  std::vector<std::string> chosen;
  for (const std::string& name : wanted) {
    if (!contains(there, name)) {
      std::string all;
      for (const std::string& t : there) all += (all.empty() ? "" : ", ") + t;
      throw Error(ErrorKind::invalid_input,
                  "--methods: " + rows.file() + " has no row of '" + name + "', only of " + all);
    }
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
  box.mean = study::mean(values);
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
          if (row->method == method && (row->*group_of == group || group == "all"))
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

ScatterPlot scatter_plot(const StudyRows& rows, const PairedGroup& all,
                         const std::string& measure) {
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
                        const std::vector<std::string>& without,
                        const study::ComparisonOptions& options) {
  MethodPair pair;
  pair.a = summary.methods.front();
  pair.b = b;
  PairingOptions pairing;
  pairing.method_a = pair.a;
  pairing.method_b = pair.b;
  pairing.without = without;
  pair.groups = pair_rows(rows.table(), pairing, rows.file());
  // The paper's order: tracing comes first.
  std::stable_partition(pair.groups.begin(), pair.groups.end(),
                        [](const PairedGroup& group) { return group.name == "task tracing"; });
  for (const PairedGroup& group : pair.groups)
    pair.comparisons.push_back(study::compare(group.measures, options));
  for (const char* measure : kSmoothness)
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
    const auto add = [&](std::vector<double>& list, const char* column) {
      const double value = rows.number(*row, column);
      if (std::isfinite(value)) list.push_back(value);
    };
    add(largest, "largest_jump");
    add(shares, "share_jumping");
    add(gaps, "gaps");
  }
  const auto jumping = std::count_if(shares.begin(), shares.end(), [](double s) { return s > 0; });
  rate.jumping_strokes = shares.empty()
                             ? kUndefined
                             : static_cast<double>(jumping) / static_cast<double>(shares.size());
  rate.jumping_steps = study::mean(shares);
  rate.median_largest = study::median(largest);
  rate.largest = largest.empty() ? kUndefined : *std::max_element(largest.begin(), largest.end());
  rate.gaps = study::mean(gaps);
  return rate;
}

study::Consistency consistency_of(const StudyRows& rows, const Summary& summary,
                                  const std::string& method, const char* measure) {
  std::map<std::vector<std::string>, std::pair<const StudyRow*, const StudyRow*>> tasks;
  for (const StudyRow* row : summary.counted) {
    if (row->method != method || row->repeat.empty()) continue;
    auto& [first, again] = tasks[{row->participant, row->shape, row->task, row->curve}];
    (row->repeat == "0" ? first : again) = row;
  }
  std::vector<double> first, again;
  for (const auto& [task, pair] : tasks) {
    if (pair.first == nullptr || pair.second == nullptr) continue;
    first.push_back(rows.number(*pair.first, measure));
    again.push_back(rows.number(*pair.second, measure));
  }
  return study::consistency(first, again);
}

FilterRate filter_rate(const StudyRows& rows, const Summary& summary,
                       const std::vector<const StudyRow*>& all, const std::string& method) {
  FilterRate rate;
  rate.method = method;
  std::size_t below_25 = 0, below_20 = 0;
  for (const StudyRow* row : all) {
    if (row->method != method) continue;
    ++rate.strokes;
    rate.too_short += rows.number(*row, "short") > 0 ? 1 : 0;
    rate.noisy += rows.number(*row, "noisy") > 0 ? 1 : 0;
    rate.inverted += rows.number(*row, "inverted") > 0 ? 1 : 0;
    if (row->failed.empty()) {
      ++rate.passed;
      const double violation = rows.number(*row, "mimicry_violation");
      below_25 += violation < 0.25 ? 1 : 0;
      below_20 += violation < 0.20 ? 1 : 0;
    } else if (!(rows.number(*row, "short") > 0 || rows.number(*row, "noisy") > 0 ||
                 rows.number(*row, "inverted") > 0)) {
      ++rate.rejected;
    }
  }
  const auto passed = static_cast<double>(rate.passed);
  const bool known = rows.has("mimicry_violation") && rate.passed > 0;
  rate.violation_below_25 = known ? static_cast<double>(below_25) / passed : kUndefined;
  rate.violation_below_20 = known ? static_cast<double>(below_20) / passed : kUndefined;
  rate.d_ep = consistency_of(rows, summary, method, "D_ep_mm");
  rate.f_g = consistency_of(rows, summary, method, "F_g");
  return rate;
}

}  // namespace

Summary summarise(const StudyRows& rows, const SummaryOptions& options) {
  Summary summary;
  summary.methods = chosen_methods(rows, options.methods);
  for (const char* measure : kPaperMeasures)
    if (rows.has(measure)) summary.measures.emplace_back(measure);
  if (summary.measures.empty())
    throw Error(ErrorKind::invalid_input,
                rows.file() +
                    ": has none of the paper's measures (D_ep_mm, K_E, ...); write it "
                    "with mimicry measure or replay");

  const std::string tutorial(study::kStudyShapes[study::kTutorialShape]);
  const auto is_tutorial = [&](const StudyRow& row) {
    return !options.keep_tutorial && !row.participant.empty() && !row.task.empty() &&
           row.shape == tutorial;
  };
  std::set<std::string> participants, tutorial_cells;
  std::vector<const StudyRow*> all;
  for (const StudyRow& row : rows.rows()) {
    if (!contains(summary.methods, row.method)) continue;
    if (is_tutorial(row)) {
      ++summary.tutorial;
      tutorial_cells.insert(row.shape_cell);
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
  std::stable_partition(summary.tasks.begin(), summary.tasks.end(),
                        [](const std::string& task) { return task == "tracing"; });
  for (const std::string_view shape : study::kStudyShapes)
    for (const StudyRow* row : all)
      if (row->shape == shape) add_once(summary.shapes, row->shape);
  for (const StudyRow* row : all) add_once(summary.shapes, row->shape);
  summary.participants = participants.size();

  std::vector<std::string> without;
  for (const std::string& cell : tutorial_cells) without.push_back("shape=" + cell);
  for (std::size_t i = 1; i < summary.methods.size(); ++i)
    summary.pairs.push_back(
        compare_pair(rows, summary, summary.methods[i], without, options.comparison));

  if (summary.tasks.empty()) summary.tasks.emplace_back("all");
  summary.by_task = boxes(rows, summary, summary.tasks, &StudyRow::task);
  summary.by_shape = boxes(rows, summary, summary.shapes, &StudyRow::shape);
  for (const std::string& method : summary.methods) {
    if (rows.has("largest_jump")) summary.jumps.push_back(jump_rate(rows, summary, method));
    summary.filters.push_back(filter_rate(rows, summary, all, method));
  }
  return summary;
}

}  // namespace mimicry::cli
