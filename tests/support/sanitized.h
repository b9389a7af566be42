#pragma once

namespace mimicry::test {

/// Sanitizers make a program some ten times slower: its tests may be smaller then.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool kSanitized = true;
#else
inline constexpr bool kSanitized = false;
#endif

}  // namespace mimicry::test
