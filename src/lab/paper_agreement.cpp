#include "lab/paper_agreement.h"

#include "lab/columns.h"
#include "lab/study_numbers.h"

namespace mimicry::lab {

const PaperFigure* published_figure(const std::string& a, const std::string& b,
                                    const std::string& group, const std::string& measure) {
  if (number_of_method(name_of_method(a)) != kSpraycan ||
      number_of_method(name_of_method(b)) != kMimicry)
    return nullptr;
  for (const auto task : {TaskKind::tracing, TaskKind::re_creating})
    if (group == group_name(column::kTask, task_name(task))) return paper_figure(measure, task);
  return nullptr;
}

void AgreementCount::add(const PaperFigure& paper, const Agreement& agreement) {
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
                               const std::vector<Comparison>& comparisons) {
  AgreementCount count;
  for (const Comparison& c : comparisons)
    if (const auto* paper = published_figure(a, b, group.name, c.name))
      count.add(*paper, agreement(c, *paper));
  return count;
}

}  // namespace mimicry::lab
