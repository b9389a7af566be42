#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include <mimicry/stroke/stroke.h>
#include <mimicry/version.h>

namespace mimicry {

/// This library's mark on strokes that it makes up. technique: whose ink was seen, or empty.
inline Simulation simulation_mark(std::uint64_t seed, std::string_view technique) {
  return {"mimicry " MIMICRY_VERSION, seed, std::string(technique)};
}

}  // namespace mimicry
