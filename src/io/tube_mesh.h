#pragma once

#include <optional>
#include <span>
#include <vector>

#include <mimicry/mesh/triangle_mesh.h>

namespace mimicry {

struct TubeOptions {
  double radius = 0.0;  ///< > 0, in the points' units
  int sides = 12;       ///< 3..1024
  bool closed = false;  ///< join the last point to the first instead of capping the ends
  std::span<const double> radii = {};  ///< in place of `radius`: one for each point, > 0; or empty
};

struct TubeMesh {
  TriangleMesh mesh;
  std::vector<Vec3> normals;  // #V, unit, outward
};

/// A round tube around a polyline, for files that hold no curves. Closed surface without boundary,
/// faces outward; half balls close the ends. Between points the radius changes linearly. Rings turn
/// with the curve without twist (parallel transport); on a closed tube what twist remains is spread
/// evenly along it. Bends of more than 15 degrees are rounded; at the others the tube is at most
/// 0.9 % thinner. Points closer than 1e-6 of the (largest) radius to the one before are passed
/// over. One point gives a ball, none an empty mesh; a closed tube needs three distinct points,
/// else it is made open. Throws Error(invalid_input) on points that are not finite and options out
/// of range, Error(unsupported) where the mesh would have more vertices than an Index counts. O(#P
/// * sides).
TubeMesh tube_mesh(std::span<const Vec3> points, const TubeOptions& options);

/// How wide ink is drawn at a pen's pressure (0 to 1), as a factor of its radius: 0.35 to 1.65, and
/// 1 where the device has no pressure. The studio draws the same.
inline double width_of_pressure(std::optional<double> pressure) {
  return pressure ? 0.35 + 1.3 * *pressure : 1.0;
}

}  // namespace mimicry
