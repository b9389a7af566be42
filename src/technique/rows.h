#pragma once

#include <vector>

#include <mimicry/technique/technique.h>

namespace mimicry {

/// The techniques that every program has, a row each: all that there is to add one.
std::vector<TechniqueInfo> built_in_techniques();

}  // namespace mimicry
