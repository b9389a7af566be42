#pragma once

#include <string>
#include <string_view>

#include <mimicry/study/target_set.h>

namespace mimicry {

/// A file of target curves as `read_targets` reads it (docs/formats.md), to the same bits. `note`
/// is for its readers.
std::string write_targets(const TargetSet& set, std::string_view note);

}  // namespace mimicry
