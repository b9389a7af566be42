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

/// null for what is not a number, which JSON has not.
nlohmann::ordered_json json_number(double value);
/// A group of pairs with its comparisons, for programs.
nlohmann::ordered_json to_json(const PairedGroup& group,
                               const std::vector<study::Comparison>& comparisons);

}  // namespace mimicry::cli
