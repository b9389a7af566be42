#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace mimicry {

/// sRGB's encoding of bytes by look-up. Every byte comes back from its linear value.
struct SrgbTables {
  std::array<float, 256> linear;
  std::array<std::uint8_t, 65536> encoded;  // by linear light in steps of 1 / 65535

  std::uint8_t encode(float x) const {
    const float clamped = x < 0.0f ? 0.0f : x > 1.0f ? 1.0f : x;
    return encoded[static_cast<std::size_t>(std::lrint(clamped * 65535.0f))];
  }
};

const SrgbTables& srgb_tables();

}  // namespace mimicry
