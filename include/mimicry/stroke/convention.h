#pragma once

#include <optional>
#include <span>
#include <string_view>

#include <mimicry/base/types.h>
#include <mimicry/stroke/frame.h>

namespace mimicry {

/// How another program writes positions and poses. Inside, everything is right-handed, y up,
/// metres, with devices that point along -z and have +y up; frames are converted when they come in
/// and when they go out.
struct CoordinateConvention {
  std::string_view name;
  /// Signed permutation: internal axes from the other program's world axes. Determinant -1 where
  /// the other program is left-handed.
  Mat3 world_axes = Mat3::Identity();
  /// The same for a device's own axes (which way a controller points); same determinant.
  Mat3 device_axes = Mat3::Identity();
  double metres_per_unit = 1.0;

  Vec3 position_in(const Vec3& x) const { return metres_per_unit * (world_axes * x); }
  Vec3 position_out(const Vec3& x) const { return world_axes.transpose() * x / metres_per_unit; }
  Vec3 direction_in(const Vec3& v) const { return world_axes * v; }
  Vec3 direction_out(const Vec3& v) const { return world_axes.transpose() * v; }
  Quat orientation_in(const Quat& q) const;
  Quat orientation_out(const Quat& q) const;
  Frame frame_in(const Frame& other) const;
  Frame frame_out(const Frame& internal) const;
  /// Where a model stands. The other program has read the mesh file with the same change of axes,
  /// so that its model's own axes change like the world's; `scale` is world units per unit of the
  /// file.
  Similarity placement_in(const Similarity& other) const;
  Similarity placement_out(const Similarity& internal) const;
};

/// openxr: right-handed, y up, metres, devices point along -z (also WebXR and glTF; the internal
/// one). unity: left-handed, y up, metres, devices point along +z. unreal: left-handed, z up,
/// centimetres, devices point along +x with +y to the right. paper: right-handed, y up, metres, the
/// spray direction is the controller's +z.
std::span<const CoordinateConvention> conventions();

/// nullptr for a name that is not in the list.
const CoordinateConvention* find_convention(std::string_view name);

}  // namespace mimicry
