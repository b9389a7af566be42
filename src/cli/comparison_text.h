#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include <mimicry/study/comparison.h>

#include "cli/paired_rows.h"

namespace mimicry::cli {

/// About three digits; "-" for what is not a number.
std::string significant(double value);
/// "<.001", ".042"; "-" for what is not a number.
std::string probability(double p);

/// p of the test over participants; "-" where there are not two of them.
std::string participants_probability(const study::Comparison& c);

/// null for what is not a number, which JSON has not.
nlohmann::ordered_json json_number(double value);
/// Groups of pairs of two methods with their comparisons, for programs; beside them the paper's
/// figures, where it has some, and what agrees with them.
nlohmann::ordered_json to_json(const std::string& a, const std::string& b,
                               const std::vector<PairedGroup>& groups,
                               const std::vector<std::vector<study::Comparison>>& comparisons);

}  // namespace mimicry::cli
