#pragma once

#if defined(__SSE__)
#include <xmmintrin.h>
#endif

#include "base/float_traps.h"

namespace mimicry::render {

/// Put one around each stretch of calls into Embree: it computes with infinities on purpose and is
/// fast only with denormals flushed to zero. All is as before when the scope ends.
class EmbreeScope {
 public:
  EmbreeScope() {
#if defined(__SSE__)
    _mm_setcsr(_mm_getcsr() | 0x8040u);  // flush to zero, denormals are zero
#endif
  }
  ~EmbreeScope() {
#if defined(__SSE__)
    _mm_setcsr(previous_);
#endif
  }
  EmbreeScope(const EmbreeScope&) = delete;
  EmbreeScope& operator=(const EmbreeScope&) = delete;

 private:
  // Members in this order: the control word is saved while the traps are already masked, so that
  // putting it back does not raise what Embree left behind; unmasking comes last.
  FloatTrapMask mask_;
#if defined(__SSE__)
  unsigned previous_ = _mm_getcsr();
#endif
};

}  // namespace mimicry::render
