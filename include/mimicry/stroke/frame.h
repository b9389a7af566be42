#pragma once

#include <optional>
#include <string>

#include <mimicry/base/similarity.h>
#include <mimicry/base/types.h>

namespace mimicry {

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
/// (stroke/convention.h).
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

}  // namespace mimicry
