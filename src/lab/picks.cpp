#include <algorithm>
#include <cmath>

#include "lab/report_data.h"

namespace mimicry::lab {
namespace {

std::vector<StrokePick> picks_of(const std::string& method, const StudyRows& rows,
                                 const Summary& summary, const std::string& measure,
                                 std::size_t count) {
  std::vector<StrokePick> all;
  for (const StudyRow* row : summary.counted) {
    const double value = rows.number(*row, measure);
    if (row->method == method && std::isfinite(value)) all.push_back({row, value, false});
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const StrokePick& a, const StrokePick& b) { return a.value > b.value; });
  const std::size_t worst = std::min(count, all.size());
  const std::size_t best = std::min(count, all.size() - worst);
  std::vector<StrokePick> picks(all.begin(), all.begin() + static_cast<long>(worst));
  for (std::size_t i = 0; i < best; ++i) {
    picks.push_back(all[all.size() - 1 - i]);
    picks.back().best = true;
  }
  return picks;
}

}  // namespace

std::vector<StrokePick> pick_strokes(const StudyRows& rows, const Summary& summary,
                                     const std::string& measure, int count) {
  std::vector<StrokePick> picks;
  for (const std::string& method : summary.methods)
    for (const StrokePick& pick :
         picks_of(method, rows, summary, measure, static_cast<std::size_t>(std::max(0, count))))
      picks.push_back(pick);
  return picks;
}

}  // namespace mimicry::lab
