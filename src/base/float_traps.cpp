#include "base/float_traps.h"

// Before the test below: a header of the C library is what defines __GLIBC__.
#include <cfenv>

#if defined(__GLIBC__) && (defined(__x86_64__) || defined(__aarch64__))

namespace mimicry {
namespace {
constexpr int kTrapped = FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW;
}

void enable_float_traps() {
  feenableexcept(kTrapped);
}

FloatTrapMask::FloatTrapMask() : previous_(fedisableexcept(kTrapped)) {}

FloatTrapMask::~FloatTrapMask() {
  // A flag that was raised inside would trap as soon as the exception is enabled again.
  feclearexcept(kTrapped);
  feenableexcept(previous_ & kTrapped);
}

}  // namespace mimicry

#else

namespace mimicry {
void enable_float_traps() {}
FloatTrapMask::FloatTrapMask() : previous_(0) {}
FloatTrapMask::~FloatTrapMask() = default;
}  // namespace mimicry

#endif
