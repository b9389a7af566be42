#pragma once

#include <cstdint>
#include <cstring>
#include <string>

namespace mimicry {

/// A number from raw bytes, in the byte order of the file, whatever the machine's.
template <class T>
T load(const char* bytes, bool big_endian = false) {
  unsigned char raw[sizeof(T)];
  std::uint64_t bits = 0;
  std::memcpy(raw, bytes, sizeof(T));
  for (std::size_t k = 0; k < sizeof(T); ++k)
    bits = bits << 8 | raw[big_endian ? k : sizeof(T) - 1 - k];
  T value;
  if constexpr (sizeof(T) == 8) {
    std::memcpy(&value, &bits, 8);
  } else if constexpr (sizeof(T) == 4) {
    const auto narrow = static_cast<std::uint32_t>(bits);
    std::memcpy(&value, &narrow, 4);
  } else {
    value = static_cast<T>(bits);
  }
  return value;
}

/// Appends the bytes of a 4- or 8-byte number, little end first.
template <class T>
void append_little_endian(std::string& out, T value) {
  std::uint64_t bits = 0;
  if constexpr (sizeof(T) == 8) {
    std::memcpy(&bits, &value, 8);
  } else {
    static_assert(sizeof(T) == 4);
    std::uint32_t narrow;
    std::memcpy(&narrow, &value, 4);
    bits = narrow;
  }
  for (std::size_t k = 0; k < sizeof(T); ++k) out += static_cast<char>(bits >> 8 * k & 0xff);
}

}  // namespace mimicry
