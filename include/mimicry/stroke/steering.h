#pragma once

#include <cstdint>

namespace mimicry {

/// What a technique makes of the controller, and so how people steer with it.
enum class Steering : std::uint8_t {
  aims,   ///< the point is where the nozzle points: people turn the wrist
  moves,  ///< the hand's place or motion counts
};

}  // namespace mimicry
