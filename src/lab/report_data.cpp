#include "lab/report_data.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "lab/columns.h"
#include "lab/comparison_json.h"
#include "lab/json.h"

namespace mimicry::lab {
namespace {

// Five digits are more than any eye sees, and half of the page.
double rounded(double value) {
  if (value == 0 || !std::isfinite(value)) return value;
  char text[32];
  std::snprintf(text, sizeof text, "%.5g", value);
  return std::strtod(text, nullptr);
}

Json to_json(const Box& box) {
  return {{"measure", box.measure},        {"method", box.method},  {"group", box.group},
          {"strokes", box.strokes},        {"p5", rounded(box.p5)}, {"q1", rounded(box.q1)},
          {"median", rounded(box.median)}, {"q3", rounded(box.q3)}, {"p95", rounded(box.p95)},
          {"mean", rounded(box.mean)}};
}

Json to_json(const ScatterPlot& plot) {
  Json points = Json::array();
  for (const ScatterPoint& point : plot.points)
    points.push_back(
        {{"x", rounded(point.x)},
         {"y", rounded(point.y)},
         // What summary.tasks calls strokes of no task: the colours go by it.
         {"task", point.stroke->task.empty() ? std::string(kAllRows) : point.stroke->task},
         {"stroke", point.stroke->name()}});
  Json line;
  if (plot.line)
    line = {{"slope", plot.line->slope},
            {"intercept", plot.line->intercept},
            {"r", plot.line->correlation}};
  return {{"measure", plot.measure}, {"points", points}, {"line", line}};
}

bool positive(const std::vector<Box>& boxes, const std::string& measure) {
  return std::all_of(boxes.begin(), boxes.end(),
                     [&](const Box& box) { return box.measure != measure || box.p5 > 0; });
}

}  // namespace

std::string file_part(std::string name) {
  for (char& c : name)
    if (!(c == '-' || (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z')))
      c = '_';
  return name;
}

std::string scatter_id(const MethodPair& pair) {
  return file_part("scatter-" + pair.a + "-" + pair.b);
}

std::string figure_data(const Summary& summary, const MethodColor& color_of) {
  Json methods = Json::array(), measures = Json::array(), by_task = Json::array(),
       by_shape = Json::array(), scatter = Json::array(), comparisons = Json::array();
  for (const std::string& name : summary.methods)
    methods.push_back({{"name", name}, {"color", color_of(name)}});
  for (const std::string& measure : summary.measures)
    measures.push_back(
        {{"id", measure},
         {"title", paper_measure(measure)->title},
         {"positive", positive(summary.by_task, measure) && positive(summary.by_shape, measure)}});
  for (const Box& box : summary.by_task) by_task.push_back(to_json(box));
  for (const Box& box : summary.by_shape) by_shape.push_back(to_json(box));
  for (const MethodPair& pair : summary.pairs) {
    Json plots = Json::array();
    for (const ScatterPlot& plot : pair.scatter) plots.push_back(to_json(plot));
    scatter.push_back({{"id", scatter_id(pair)}, {"a", pair.a}, {"b", pair.b}, {"plots", plots}});
    comparisons.push_back(compared_json(pair.a, pair.b, pair.groups, pair.comparisons));
  }
  const Json data = {{"methods", methods},       {"tasks", summary.tasks},
                     {"shapes", summary.shapes}, {"measures", measures},
                     {"by_task", by_task},       {"by_shape", by_shape},
                     {"scatter", scatter},       {"comparisons", comparisons}};
  return json_text(data, -1);
}

}  // namespace mimicry::lab
