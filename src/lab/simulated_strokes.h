#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <mimicry/assets/canvas.h>
#include <mimicry/spatial/target.h>
#include <mimicry/stroke/stroke.h>
#include <mimicry/technique/technique.h>

namespace mimicry::lab {

struct SimulatedStrokesOptions {
  std::string mesh;     ///< as `load_mesh` takes it
  std::string targets;  ///< file of target curves; empty: a built-in shape's intended curves
  std::string shape;    ///< whose curves; empty: those of the mesh's name
  std::vector<std::string> curves;  ///< only these; empty: all
  /// The person sees the ink of these and corrects the visible error: strokes for each. Empty:
  /// strokes without any ink.
  std::vector<const TechniqueInfo*> closed_loop;
  int count = 1;              ///< strokes for each curve
  std::uint64_t seed = 1;     ///< of all that is random
  double rate_hz = 90.0;      ///< frames a second
  double distance_m = 0.048;  ///< mean, from hand to surface
  double scale = 0.0;         ///< metres per mesh unit; 0: the shape's own
  bool z_up = false;          ///< the mesh's up; else y
  TargetOptions target;
};

/// Mid-air strokes as a person would make them who means given curves (study/simulate.h), marked as
/// simulated. Same options, same bits. Throws Error where mesh or curves cannot be had, or no curve
/// is of a name that is asked for.
std::vector<Stroke> simulated_strokes(const SimulatedStrokesOptions& options,
                                      const Monitor& monitor = {});

}  // namespace mimicry::lab
