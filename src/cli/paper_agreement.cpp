#include "cli/paper_agreement.h"

namespace mimicry::cli {

using Json = nlohmann::ordered_json;

const study::PaperFigure* paper_figure(const std::string& a, const std::string& b,
                                       const std::string& group, const std::string& measure) {
  if (!is_method(a, "spraycan") || !is_method(b, "mimicry")) return nullptr;
  if (group == "task tracing") return study::paper_figure(measure, study::TaskKind::tracing);
  if (group == "task re-creating")
    return study::paper_figure(measure, study::TaskKind::re_creating);
  return nullptr;
}

void AgreementCount::add(const study::PaperFigure& paper, const study::Agreement& agreement) {
  ++rows;
  means += agreement.means() ? 1 : 0;
  differences += agreement.difference(paper) ? 1 : 0;
}

AgreementCount& AgreementCount::operator+=(const AgreementCount& other) {
  rows += other.rows;
  means += other.means;
  differences += other.differences;
  return *this;
}

std::string AgreementCount::text() const {
  const std::string of = " of " + std::to_string(rows) + " rows";
  return "both means within 25 % of the paper's in " + std::to_string(means) + of +
         ", the difference with its sign and significance in " + std::to_string(differences) + of;
}

AgreementCount count_agreement(const std::string& a, const std::string& b, const PairedGroup& group,
                               const std::vector<study::Comparison>& comparisons) {
  AgreementCount count;
  for (const study::Comparison& c : comparisons)
    if (const auto* paper = paper_figure(a, b, group.name, c.name))
      count.add(*paper, study::agreement(c, *paper));
  return count;
}

Json to_json(const study::PaperFigure& paper, const study::Agreement& agreement) {
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

}  // namespace mimicry::cli
