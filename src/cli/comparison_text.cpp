#include "cli/comparison_text.h"

#include <cmath>

#include "cli/console.h"
#include "cli/paper_agreement.h"

namespace mimicry::cli {
namespace {

using Json = nlohmann::ordered_json;

Json to_json(const study::Moments& m) {
  return {{"mean", json_number(m.mean)},
          {"standard_deviation", json_number(m.standard_deviation)},
          {"median", json_number(m.median)}};
}

Json participants_json(const study::Comparison& c) {
  if (c.participants == 0) return {};
  return {{"count", c.participants},
          {"z", c.by_participant.z},
          {"p", c.by_participant.p()},
          {"rank_biserial", c.by_participant.rank_biserial}};
}

Json group_json(const std::string& a, const std::string& b, const PairedGroup& group,
                const std::vector<study::Comparison>& comparisons) {
  Json list = Json::array();
  for (const study::Comparison& c : comparisons) {
    list.push_back(
        {{"measure", c.name},
         {"pairs", c.pairs},
         {"a", to_json(c.a)},
         {"b", to_json(c.b)},
         {"differences", c.test.differences},
         {"w_plus", c.test.w_plus},
         {"z", c.test.z},
         {"p", c.test.p()},
         {"p_normal", c.test.p_normal},
         {"p_exact", c.test.p_exact ? Json(*c.test.p_exact) : Json()},
         {"p_holm", json_number(c.p_holm)},
         {"participants", participants_json(c)},
         {"effect_r", c.test.effect_r},
         {"rank_biserial", c.test.rank_biserial},
         {"difference", {json_number(c.difference.low), json_number(c.difference.high)}}});
    if (const auto* paper = paper_figure(a, b, group.name, c.name))
      list.back()["paper"] = cli::to_json(*paper, study::agreement(c, *paper));
  }
  return {{"group", group.name},
          {"pairs", group.pairs},
          {"left_out", group.failed},
          {"unpaired", group.unpaired},
          {"measures", list}};
}

}  // namespace

std::string significant(double value) {
  if (!std::isfinite(value)) return "-";
  const double size = std::abs(value);
  if (size == 0) return "0";
  return fixed(value, size >= 100 ? 0 : size >= 10 ? 1 : size >= 0.1 ? 2 : size >= 0.01 ? 3 : 4);
}

std::string probability(double p) {
  if (!std::isfinite(p)) return "-";
  if (p < 0.001) return "<.001";
  const std::string text = fixed(p, 3);
  return text.front() == '0' ? text.substr(1) : text;
}

std::string participants_probability(const study::Comparison& c) {
  return c.participants > 1 ? probability(c.by_participant.p()) : "-";
}

Json json_number(double value) {
  return std::isfinite(value) ? Json(value) : Json();
}

Json to_json(const std::string& a, const std::string& b, const std::vector<PairedGroup>& groups,
             const std::vector<std::vector<study::Comparison>>& comparisons) {
  Json list = Json::array();
  AgreementCount agreement;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    list.push_back(group_json(a, b, groups[g], comparisons[g]));
    agreement += count_agreement(a, b, groups[g], comparisons[g]);
  }
  Json json = {{"a", a}, {"b", b}, {"groups", list}};
  if (agreement.rows > 0) json["agreement"] = cli::to_json(agreement);
  return json;
}

}  // namespace mimicry::cli
