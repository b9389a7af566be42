#pragma once

#include <string>
#include <vector>

#include <mimicry/assets/canvas.h>

namespace mimicry {

/// The techniques of these names in the registry's order, each once; all where there are no names
/// or one is `all`. Throws Error(invalid_input) for a name that does not exist.
std::vector<const TechniqueInfo*> chosen_techniques(const std::vector<std::string>& names);

}  // namespace mimicry
