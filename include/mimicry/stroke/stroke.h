#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <mimicry/base/types.h>
#include <mimicry/mesh/triangle_mesh.h>

namespace mimicry {

/// What a technique makes of the controller, and so how people steer with it.
enum class Steering : std::uint8_t {
  aims,   ///< the point is where the nozzle points: people turn the wrist
  moves,  ///< the hand's place or motion counts
};

/// Where a device is and how it is turned: x_world = orientation * x_device + position. Devices
/// point along their -z axis and have +y up (OpenXR, WebXR).
struct Pose {
  Vec3 position = Vec3::Zero();
  Quat orientation = Quat::Identity();

  Vec3 forward() const { return orientation * -Vec3::UnitZ(); }
  Vec3 up() const { return orientation * Vec3::UnitY(); }
};

/// One 6-DoF sample. In a stroke: right-handed world, y up, metres. In a technique: the target's
/// own coordinates and units (`to_model`). Other conventions are converted at the border
/// (`CoordinateConvention`).
struct Frame {
  double time_s = 0.0;  ///< on any clock; must not run backwards inside a stroke
  Pose head;
  Pose controller;                 ///< position: the pen's tip, p_i
  double trigger = 1.0;            ///< 0 to 1
  std::optional<double> pressure;  ///< 0 to 1, where the device has it
};

/// The frame seen from the target: positions in model units, orientations in model axes.
Frame to_model(const Frame& world, const Similarity& model_to_world);

/// How far from 1 a quaternion's length may be before it is refused; what is nearer is normalised.
/// Single-precision devices stay below 1e-6.
inline constexpr double kUnitTolerance = 1e-3;

/// No device is farther from its origin, metres: what is lies in a broken recording.
inline constexpr double kFarthest_m = 1e9;

/// Why a frame cannot be used, empty where it can: a number that is not finite, a position beyond
/// kFarthest_m, a quaternion whose length is not 1 within kUnitTolerance, trigger or pressure
/// outside 0..1, or a time before `previous_time_s`.
std::optional<std::string> frame_problem(const Frame& frame, double previous_time_s = -kInfinity);
/// `frame_problem` is empty; allocates nothing.
bool is_usable(const Frame& frame, double previous_time_s = -kInfinity);

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

/// The curve that the drawer of a stroke meant, where it is known (synthetic strokes, study tasks).
struct Intention {
  std::string name;
  bool closed = false;
  std::vector<SurfacePoint> points;
};

/// Says of a stroke that a program made it, and how to make it again: the same program gives the
/// same stroke.
struct Simulation {
  std::string program;     ///< with its version: "mimicry 0.1.0"
  std::uint64_t seed = 0;  ///< of all that is random, as it was given to the program
  std::string technique;   ///< whose ink the simulated person saw (closed loop); empty: none
};

struct Stroke {  // what the devices did while the trigger was held, on one target
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
