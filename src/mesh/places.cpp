#include "mesh/places.h"

#include <array>
#include <cstdint>
#include <cstring>

#include "base/finite.h"

namespace mimicry {
namespace {

using Bits = std::array<std::uint64_t, 3>;

Bits bits_of(const Vec3& p) {
  // Not by adding 0: that would trap on signalling numbers.
  constexpr std::uint64_t kNegativeZero = std::uint64_t{1} << 63;
  Bits bits;
  std::memcpy(bits.data(), p.data(), sizeof(bits));
  for (std::uint64_t& word : bits)
    if (word == kNegativeZero) word = 0;
  return bits;
}

}  // namespace

std::vector<Index> equal_places(std::span<const Vec3> positions) {
  // Open addressing, at most half full.
  std::size_t size = 16;
  while (size < 2 * positions.size()) size *= 2;
  std::vector<Index> slots(size, kNone);
  std::vector<Index> place(positions.size());
  for (std::size_t v = 0; v < positions.size(); ++v) {
    place[v] = static_cast<Index>(v);
    if (!is_finite(positions[v])) continue;
    const Bits bits = bits_of(positions[v]);
    std::uint64_t hash = 0;
    for (const std::uint64_t word : bits) {
      hash = (hash ^ word) * 0x9e3779b97f4a7c15u;
      hash ^= hash >> 32;
    }
    std::size_t slot = hash & (size - 1);
    while (slots[slot] != kNone && bits_of(positions[at(slots[slot])]) != bits)
      slot = (slot + 1) & (size - 1);
    if (slots[slot] == kNone) slots[slot] = static_cast<Index>(v);
    place[v] = slots[slot];
  }
  return place;
}

}  // namespace mimicry
