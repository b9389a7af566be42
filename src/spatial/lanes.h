#pragma once

#include "base/compiler.h"

namespace mimicry {

using mimicry::Double4;
using mimicry::Float4;
using mimicry::Mask4;

inline Float4 splat(float x) {
  return Float4{x, x, x, x};
}
inline Float4 min(Float4 a, Float4 b) {
  return select(a < b, a, b);
}
inline Float4 max(Float4 a, Float4 b) {
  return select(a > b, a, b);
}

}  // namespace mimicry
