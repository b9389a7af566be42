#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <mimicry/study/comparison.h>

#include "lab/pairing.h"

namespace mimicry::lab {

/// The paper's figure for a comparison in a group of pairs ("task tracing") of two methods, called
/// by names or by the study's numbers; nullptr where the paper has none.
const PaperFigure* published_figure(const std::string& a, const std::string& b,
                                    const std::string& group, const std::string& measure);

/// How many rows of the paper's table agree with what was measured.
struct AgreementCount {
  std::size_t rows = 0;         ///< with a figure of the paper
  std::size_t means = 0;        ///< both means within 25 %
  std::size_t differences = 0;  ///< sign and significance

  void add(const PaperFigure& paper, const Agreement& agreement);
  AgreementCount& operator+=(const AgreementCount& other);
  /// "both means within 25 % of the paper's in 12 of 20 rows, ...".
  std::string text() const;
};

AgreementCount count_agreement(const std::string& a, const std::string& b, const PairedGroup& group,
                               const std::vector<Comparison>& comparisons);

}  // namespace mimicry::lab
