#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <mimicry/base/similarity.h>
#include <mimicry/mesh/surface_point.h>
#include <mimicry/stroke/frame.h>

namespace mimicry {

/// The curve that the drawer of a stroke meant, where it is known (synthetic strokes, study tasks).
struct Intention {
  std::string name;
  bool closed = false;
  std::vector<SurfacePoint> points;
};

/// A recorded stroke: what the devices did while the trigger was held, on one target.
/// Says of a stroke that a program made it, and how to make it again.
struct Simulation {
  std::string program;     ///< with its version: "mimicry 0.1.0"
  std::uint64_t seed = 0;  ///< of all that is random, as it was given to the program
  std::string technique;   ///< whose ink the simulated person saw (closed loop); empty: none
};

struct Stroke {
  std::string id;
  std::string target;         ///< name of the mesh that was drawn on
  Similarity model_to_world;  ///< where and how large the target stood
  std::vector<Frame> frames;  ///< world, time does not decrease
  std::optional<Intention> intended;
  std::optional<Simulation> simulated;  ///< none: recorded from a person, as far as is known
};

/// Throws Error(invalid_input) naming the stroke and the frame for the first frame that cannot be
/// used (`frame_problem`), or for a model_to_world that is not a similarity (finite, unit rotation,
/// scale > 0). A stroke without frames is legal. O(frames).
void require_usable(const Stroke& stroke);

}  // namespace mimicry
