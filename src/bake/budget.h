#pragma once

namespace mimicry::bake {

/// What a bake may take, and what solving may, of what docs/quality-of-bakes.md says. A fuzzer's
/// bakes are far smaller and otherwise the same, so that it tries more of them.
#ifdef FUZZING_BUILD_MODE_UNSAFE_FOR_PRODUCTION
inline constexpr double kBudget = 0.02, kWorkBudget = 0.001;
#else
inline constexpr double kBudget = 1.0, kWorkBudget = 1.0;
#endif

}  // namespace mimicry::bake
