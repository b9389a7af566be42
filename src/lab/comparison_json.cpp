#include "lab/comparison_json.h"

#include <cmath>

#include "lab/paper_agreement.h"
#include "lab/report_data.h"

namespace mimicry::lab {
namespace {

// null for what is not a number, which JSON has not.
Json json_number(double value) {
  return std::isfinite(value) ? Json(value) : Json();
}

// The figure and what agrees with it.
Json to_json(const PaperFigure& paper, const Agreement& agreement) {
  return {{"a", {{"mean", paper.spraycan}, {"standard_deviation", paper.spraycan_deviation}}},
          {"b", {{"mean", paper.mimicry}, {"standard_deviation", paper.mimicry_deviation}}},
          {"z", paper.z},
          {"p", std::string(paper.p)},
          {"agrees",
           {{"a", agreement.spraycan_mean},
            {"b", agreement.mimicry_mean},
            {"means", agreement.means()},
            {"sign", agreement.sign},
            {"significance", agreement.significance},
            {"difference", agreement.difference(paper)}}}};
}

Json to_json(const AgreementCount& count) {
  return {{"rows", count.rows}, {"means", count.means}, {"differences", count.differences}};
}

Json to_json(const Moments& m) {
  return {{"mean", json_number(m.mean)},
          {"standard_deviation", json_number(m.standard_deviation)},
          {"median", json_number(m.median)}};
}

Json participants_json(const Comparison& c) {
  if (c.participants == 0) return {};
  return {{"count", c.participants},
          {"z", c.by_participant.z},
          {"p", c.by_participant.p()},
          {"rank_biserial", c.by_participant.rank_biserial}};
}

Json group_json(const std::string& a, const std::string& b, const PairedGroup& group,
                const std::vector<Comparison>& comparisons) {
  Json list = Json::array();
  for (const Comparison& c : comparisons) {
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
    if (const auto* paper = published_figure(a, b, group.name, c.name))
      list.back()["paper"] = to_json(*paper, agreement(c, *paper));
  }
  return {{"group", group.name},
          {"pairs", group.pairs},
          {"left_out", group.failed},
          {"unpaired", group.unpaired},
          {"measures", list}};
}

}  // namespace

Json compared_json(const std::string& a, const std::string& b,
                   const std::vector<PairedGroup>& groups,
                   const std::vector<std::vector<Comparison>>& comparisons) {
  Json list = Json::array();
  AgreementCount agreement;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    list.push_back(group_json(a, b, groups[g], comparisons[g]));
    agreement += count_agreement(a, b, groups[g], comparisons[g]);
  }
  Json json = {{"a", a}, {"b", b}, {"groups", list}};
  if (agreement.rows > 0) json["agreement"] = to_json(agreement);
  return json;
}

std::string comparison_json(const std::string& a, const std::string& b,
                            const std::vector<PairedGroup>& groups,
                            const std::vector<std::vector<Comparison>>& comparisons) {
  return json_text(compared_json(a, b, groups, comparisons), 2);
}

}  // namespace mimicry::lab
