#pragma once

#include <string>
#include <vector>

#include "lab/json.h"
#include "lab/pairing.h"

namespace mimicry::lab {

/// What `comparison_json` writes.
Json compared_json(const std::string& a, const std::string& b,
                   const std::vector<PairedGroup>& groups,
                   const std::vector<std::vector<Comparison>>& comparisons);

}  // namespace mimicry::lab
