#include "cli/project_table.h"

#include <algorithm>
#include <cstdio>

#include <nlohmann/json.hpp>

#include <mimicry/base/error.h>
#include <mimicry/study/measures.h>

#include "cli/console.h"

namespace mimicry::cli {
namespace {

using Json = nlohmann::ordered_json;

// Where nothing was intended the curve stands for itself: distances are 0 and not used.
TargetCurve intended_or_drawn(const Stroke& stroke, const ProjectedCurve& curve) {
  TargetCurve target;
  if (stroke.intended && !stroke.intended->points.empty())
    target.points = stroke.intended->points;
  else
    for (const CurvePoint& p : curve.points) target.points.push_back(p.surface);
  return target;
}

Json optional_number(std::optional<double> value) {
  return value ? Json(*value) : Json();
}

Json to_json(const MeasureSums& sums) {
  const bool any = sums.strokes > 0;
  return {{"strokes", sums.strokes},
          {"d_ep_m", optional_number(sums.mean_d_ep_m())},
          {"k_e_rad_per_m", any ? Json(sums.mean_k_e()) : Json()},
          {"share_jumping", any ? Json(sums.mean_share_jumping()) : Json()}};
}

std::string title(Drawers drawers) {
  switch (drawers) {
    case Drawers::closed_loop:
      return "ink seen: ";
    case Drawers::open_loop:
      return "blind: ";
    case Drawers::recorded:
      break;
  }
  return "";
}

void add_cells(const MeasureSums& sums, std::vector<std::string>& cells) {
  const auto off = sums.mean_d_ep_m();
  cells.push_back(off ? fixed(1e3 * *off, 1) : "-");
  cells.push_back(sums.strokes > 0 ? fixed(sums.mean_k_e(), 0) : "-");
  cells.push_back(sums.strokes > 0 ? fixed(100.0 * sums.mean_share_jumping(), 2) : "-");
}

std::string percent(std::size_t part, std::size_t all) {
  return all > 0 ? fixed(100.0 * static_cast<double>(part) / static_cast<double>(all), 1) : "-";
}

void print_legend(const TableTitles& titles) {
  std::printf(
      "off: mean distance from the intended curve (D_ep). K_E: how much the curve turns on a metre "
      "of it, less is smoother.\njumps: steps of the curve more than 5 times as long as the "
      "hand's. missed: frames without a point.\n");
  const auto has = [&](Drawers d) { return titles.strokes == d || titles.beside == d; };
  if (has(Drawers::closed_loop))
    std::printf(
        "ink seen: simulated people who see what they draw, and correct it (closed loop).\n");
  if (has(Drawers::open_loop))
    std::printf("blind: simulated strokes of a hand that never looks at the ink (open loop).\n");
}

}  // namespace

void MeasureSums::add(const Target& target, const Stroke& stroke, const ProjectedCurve& curve) {
  if (curve.points.empty()) return;
  try {
    const IntendedCurve meant = intended_curve(target.mesh(), intended_or_drawn(stroke, curve),
                                               stroke.model_to_world.scale);
    const Measures m = measure(target.surface(), meant, curve, motion_of(stroke));
    ++strokes;
    k_e_rad_per_m += m.k_e_rad_per_m;
    share_jumping += m.share_jumping;
    if (!stroke.intended || stroke.intended->points.empty()) return;
    ++intended;
    d_ep_m += m.d_ep_m;
  } catch (const Error&) {
    // A dot, or an intended curve without length: there is nothing to measure.
  }
}

std::optional<double> MeasureSums::mean_d_ep_m() const {
  if (intended == 0) return std::nullopt;
  return d_ep_m / static_cast<double>(intended);
}

std::size_t TechniqueRow::fallbacks() const {
  Index sum = 0;
  for (const StrokeCounts& s : strokes)
    for (const auto answer : {Answer::outside_shell, Answer::no_phong_solution, Answer::replaced})
      sum += s.answers[answer];
  return static_cast<std::size_t>(sum);
}

Drawers drawers_of(const std::vector<Stroke>& strokes) {
  const auto all = [&](auto&& is) {
    return !strokes.empty() && std::all_of(strokes.begin(), strokes.end(), is);
  };
  if (all([](const auto& s) { return s.simulated && !s.simulated->technique.empty(); }))
    return Drawers::closed_loop;
  if (all([](const auto& s) { return s.simulated && s.simulated->technique.empty(); }))
    return Drawers::open_loop;
  return Drawers::recorded;
}

void print_rows(const std::vector<TechniqueRow>& rows, const TableTitles& titles) {
  std::vector<std::string> headings = {"technique"};
  const auto head = [&](Drawers drawers) {
    headings.push_back(title(drawers) + "off mm");
    headings.insert(headings.end(), {"K_E rad/m", "jumps %"});
  };
  head(titles.strokes);
  if (titles.beside) head(*titles.beside);
  headings.insert(headings.end(), {"missed %", "not smooth %", "length cm", "us a frame"});
  std::vector<std::vector<std::string>> cells;
  for (const TechniqueRow& row : rows) {
    auto& line = cells.emplace_back();
    line.emplace_back(row.technique->name);
    add_cells(row.measures, line);
    if (titles.beside) add_cells(row.beside, line);
    line.push_back(percent(row.missed, row.frames));
    line.push_back(row.technique->needs_bake ? percent(row.fallbacks(), row.frames) : "-");
    line.push_back(fixed(100.0 * row.length_m, 1));
    line.push_back(row.frames > 0 ? fixed(1e6 * row.seconds / double(row.frames), 2) : "-");
  }
  print_table(headings, cells);
  print_legend(titles);
}

void print_rows_json(const std::vector<TechniqueRow>& rows, const std::vector<std::string>& files) {
  Json list = Json::array();
  for (const TechniqueRow& row : rows) {
    Json entry = {{"technique", row.technique->name},
                  {"frames", row.frames},
                  {"points", row.points},
                  {"missed", row.missed},
                  {"length_m", row.length_m}};
    entry["mean_distance_to_intended_m"] =
        row.distances > 0 ? Json(row.distance_sum_m / double(row.distances)) : Json();
    entry["seconds_per_frame"] = row.frames > 0 ? Json(row.seconds / double(row.frames)) : Json();
    entry["measures"] = to_json(row.measures);
    if (row.beside.strokes > 0) entry["beside"] = to_json(row.beside);
    for (const StrokeCounts& s : row.strokes) {
      Json answers = Json::object();
      for (std::size_t a = 0; a < kAnswerCount; ++a)
        if (s.answers.by_answer[a] > 0)
          answers[std::string(answer_name(static_cast<Answer>(a)))] = s.answers.by_answer[a];
      entry["strokes"].push_back(
          {{"stroke", s.stroke}, {"points", s.points}, {"answers", answers}});
    }
    list.push_back(entry);
  }
  std::printf("%s\n", json_text({{"techniques", list}, {"files", files}}).c_str());
}

}  // namespace mimicry::cli
