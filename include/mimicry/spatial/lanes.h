#pragma once

#include <cstdint>

namespace mimicry::spatial {

/// Four floats in one register through the compiler's vector extension, which gcc and clang share
/// for every processor and for WebAssembly.
using Float4 = float __attribute__((vector_size(16)));
using Mask4 = std::int32_t __attribute__((vector_size(16)));

inline Float4 splat(float x) {
  return Float4{x, x, x, x};
}
inline Float4 min(Float4 a, Float4 b) {
  return a < b ? a : b;
}
inline Float4 max(Float4 a, Float4 b) {
  return a > b ? a : b;
}
inline Float4 abs(Float4 a) {
  return reinterpret_cast<Float4>(reinterpret_cast<Mask4>(a) & 0x7FFFFFFF);
}
/// Bit k is set where lane k of the comparison holds.
inline unsigned bits(Mask4 m) {
#if defined(__wasm_simd128__)
  return static_cast<unsigned>(__builtin_wasm_bitmask_i32x4(m));
#elif defined(__SSE2__)
  return static_cast<unsigned>(__builtin_ia32_movmskps(reinterpret_cast<Float4>(m)));
#else
  return (m[0] & 1U) | (m[1] & 2U) | (m[2] & 4U) | (m[3] & 8U);
#endif
}

}  // namespace mimicry::spatial
