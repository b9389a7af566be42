#pragma once

#include <string>

#include <mimicry/study/simulate.h>

namespace mimicry {

/// Throws Error(invalid_input).
[[noreturn]] void refuse_simulation(const std::string& what);

/// Throws Error(invalid_input) naming the option that is out of its range.
void check_simulation(const SimulationOptions& options);

}  // namespace mimicry
