#pragma once

#include <string>

#include <mimicry/assets/files.h>

namespace mimicry {

/// The shape of this name in a set. Throws Error(invalid_input) with the names that there are.
const TargetShape& find_target_shape(const TargetSet& set, const std::string& name,
                                     const std::string& file);

}  // namespace mimicry
