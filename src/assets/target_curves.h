#pragma once

#include <string>

#include <mimicry/study/targets.h>

namespace mimicry::assets {

/// Reads a file of target curves. Throws Error as the readers do.
TargetSet load_targets(const std::string& path);

/// The shape of this name in a set. Throws Error(invalid_input) with the names that there are.
const TargetShape& find_target_shape(const TargetSet& set, const std::string& name,
                                     const std::string& file);

}  // namespace mimicry::assets
