#pragma once

// What compilers have beyond the language, in one place, each with a twin in plain C++ that gives
// the same bits. MIMICRY_PORTABLE takes the twins everywhere; a compiler that is neither gcc nor
// clang takes them by itself.

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#if !defined(MIMICRY_PORTABLE) && !defined(__GNUC__)
#define MIMICRY_PORTABLE 1
#endif

/// Of a function whose arguments must stay in registers.
#if defined(__GNUC__)
#define MIMICRY_INLINE [[gnu::always_inline]] inline
#elif defined(_MSC_VER)
#define MIMICRY_INLINE __forceinline
#else
#define MIMICRY_INLINE inline
#endif

namespace mimicry {

/// Number of the lowest bit that is set. bits: not 0.
inline int lowest_bit(unsigned bits) {
#if defined(MIMICRY_PORTABLE)
  return std::countr_zero(bits);
#else
  return __builtin_ctz(bits);  // without countr_zero's test for 0
#endif
}

#if !defined(MIMICRY_PORTABLE)

/// Four numbers in one register, or two, through the vector extension that gcc and clang share for
/// every processor and for WebAssembly. A comparison gives a Mask4: -1 in each lane where it holds.
using Float4 = float __attribute__((vector_size(16)));
using Double4 = double __attribute__((vector_size(32)));
using Mask4 = std::int32_t __attribute__((vector_size(16)));

/// By lane: a where the mask is set, else b.
inline Float4 select(Mask4 mask, Float4 a, Float4 b) {
  return mask ? a : b;
}
inline Float4 abs(Float4 a) {
  return reinterpret_cast<Float4>(reinterpret_cast<Mask4>(a) & 0x7FFFFFFF);
}
inline Float4 to_float(const Double4& a) {
  return __builtin_convertvector(a, Float4);
}
/// Bit k is set where lane k of the mask is.
inline unsigned bits(Mask4 m) {
#if defined(__wasm_simd128__)
  return static_cast<unsigned>(__builtin_wasm_bitmask_i32x4(m));
#elif defined(__SSE2__)
  return static_cast<unsigned>(__builtin_ia32_movmskps(reinterpret_cast<Float4>(m)));
#else
  return (m[0] & 1U) | (m[1] & 2U) | (m[2] & 4U) | (m[3] & 8U);
#endif
}

/// Whole numbers of 128 bits.
__extension__ typedef __int128 Int128;

#else

/// Four numbers side by side, as the vector extension has them.
template <class T>
struct alignas(4 * sizeof(T)) Lanes4 {
  T lanes[4];

  T& operator[](std::size_t lane) { return lanes[lane]; }
  const T& operator[](std::size_t lane) const { return lanes[lane]; }
};
using Float4 = Lanes4<float>;
using Double4 = Lanes4<double>;
using Mask4 = Lanes4<std::int32_t>;

namespace detail {
template <class To, class From, class Operation>
inline Lanes4<To> by_lane(const Lanes4<From>& a, const Lanes4<From>& b, Operation&& operation) {
  Lanes4<To> c;
  for (std::size_t k = 0; k < 4; ++k) c[k] = operation(a[k], b[k]);
  return c;
}
template <class T, class Comparison>
inline Mask4 compared(const Lanes4<T>& a, const Lanes4<T>& b, Comparison&& holds) {
  return by_lane<std::int32_t>(a, b, [&](T x, T y) { return holds(x, y) ? -1 : 0; });
}
}  // namespace detail

template <class T>
inline Lanes4<T> operator+(const Lanes4<T>& a, const Lanes4<T>& b) {
  return detail::by_lane<T>(a, b, [](T x, T y) { return x + y; });
}
template <class T>
inline Lanes4<T> operator-(const Lanes4<T>& a, const Lanes4<T>& b) {
  return detail::by_lane<T>(a, b, [](T x, T y) { return x - y; });
}
template <class T>
inline Lanes4<T> operator*(const Lanes4<T>& a, const Lanes4<T>& b) {
  return detail::by_lane<T>(a, b, [](T x, T y) { return x * y; });
}
inline Float4 operator/(const Float4& a, const Float4& b) {
  return detail::by_lane<float>(a, b, [](float x, float y) { return x / y; });
}
inline Float4 operator*(const Float4& a, float b) {
  return {{a[0] * b, a[1] * b, a[2] * b, a[3] * b}};
}
template <class T>
inline Lanes4<T> operator-(const Lanes4<T>& a) {
  return {{-a[0], -a[1], -a[2], -a[3]}};
}
template <class T>
inline Lanes4<T>& operator+=(Lanes4<T>& a, const Lanes4<T>& b) {
  return a = a + b;
}
template <class T>
inline Lanes4<T>& operator*=(Lanes4<T>& a, const Lanes4<T>& b) {
  return a = a * b;
}
inline Mask4 operator<(const Float4& a, const Float4& b) {
  return detail::compared(a, b, [](float x, float y) { return x < y; });
}
inline Mask4 operator>(const Float4& a, const Float4& b) {
  return b < a;
}
inline Mask4 operator<=(const Float4& a, const Float4& b) {
  return detail::compared(a, b, [](float x, float y) { return x <= y; });
}
inline Mask4 operator>=(const Float4& a, const Float4& b) {
  return b <= a;
}
inline Mask4 operator&(const Mask4& a, const Mask4& b) {
  return detail::by_lane<std::int32_t>(a, b, [](auto x, auto y) { return x & y; });
}
inline Mask4 operator|(const Mask4& a, const Mask4& b) {
  return detail::by_lane<std::int32_t>(a, b, [](auto x, auto y) { return x | y; });
}
inline Mask4& operator&=(Mask4& a, const Mask4& b) {
  return a = a & b;
}

inline Float4 select(const Mask4& mask, const Float4& a, const Float4& b) {
  Float4 c;
  for (std::size_t k = 0; k < 4; ++k) c[k] = mask[k] != 0 ? a[k] : b[k];
  return c;
}
inline Float4 abs(const Float4& a) {
  Float4 b;
  for (std::size_t k = 0; k < 4; ++k)
    b[k] = std::bit_cast<float>(std::bit_cast<std::uint32_t>(a[k]) & 0x7FFFFFFFU);
  return b;
}
inline Float4 to_float(const Double4& a) {
  return {{static_cast<float>(a[0]), static_cast<float>(a[1]), static_cast<float>(a[2]),
           static_cast<float>(a[3])}};
}
inline unsigned bits(const Mask4& m) {
  unsigned set = 0;
  for (std::size_t k = 0; k < 4; ++k) set |= m[k] != 0 ? 1U << k : 0U;
  return set;
}

/// Whole numbers of 128 bits, two's complement; of the operations, what exact signs need.
class Int128 {
 public:
  constexpr Int128(std::int64_t x = 0)
      : low_(static_cast<std::uint64_t>(x)), high_(x < 0 ? ~std::uint64_t{0} : 0) {}

  friend constexpr Int128 operator+(const Int128& a, const Int128& b) {
    const std::uint64_t low = a.low_ + b.low_;
    return {low, a.high_ + b.high_ + (low < a.low_ ? 1U : 0U)};
  }
  friend constexpr Int128 operator-(const Int128& a, const Int128& b) {
    return {a.low_ - b.low_, a.high_ - b.high_ - (a.low_ < b.low_ ? 1U : 0U)};
  }
  friend constexpr Int128 operator*(const Int128& a, const Int128& b) {
    Int128 product = product_of(a.low_, b.low_);
    product.high_ += a.low_ * b.high_ + a.high_ * b.low_;
    return product;
  }
  friend constexpr bool operator==(const Int128&, const Int128&) = default;
  friend constexpr bool operator<(const Int128& a, const Int128& b) {
    const auto high = [](const Int128& x) { return static_cast<std::int64_t>(x.high_); };
    return a.high_ != b.high_ ? high(a) < high(b) : a.low_ < b.low_;
  }
  friend constexpr bool operator>(const Int128& a, const Int128& b) { return b < a; }

 private:
  constexpr Int128(std::uint64_t low, std::uint64_t high) : low_(low), high_(high) {}
  static constexpr Int128 product_of(std::uint64_t a, std::uint64_t b) {
    constexpr std::uint64_t kHalf = 0xFFFFFFFFU;
    const std::uint64_t a0 = a & kHalf, a1 = a >> 32, b0 = b & kHalf, b1 = b >> 32;
    const std::uint64_t middle = a1 * b0 + (a0 * b0 >> 32);  // below 2^64
    const std::uint64_t other = a0 * b1 + (middle & kHalf);
    return {a * b, a1 * b1 + (middle >> 32) + (other >> 32)};
  }

  std::uint64_t low_ = 0, high_ = 0;
};

#endif

}  // namespace mimicry
