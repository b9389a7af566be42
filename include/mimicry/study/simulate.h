#pragma once

#include <cstdint>
#include <functional>
#include <numbers>
#include <optional>

#include <mimicry/spatial/target.h>
#include <mimicry/stroke/stroke.h>

namespace mimicry {

/// The curve in the air that the hand follows.
enum class HandCopy {
  automatic,   ///< translated unless the surface turns more than 90 degrees from its mean normal
  translated,  ///< the intended curve, moved along its mean normal
  offset,      ///< the intended curve on an offset surface
  placed,      ///< translated, seeing the first point within slant_rad of the normal there
  turned,      ///< translated, but turned to stay within slant_rad of the surface's normal
};

/// What a person does when drawing. "Study" marks what was seen in the paper's study or is asked
/// for by its authors' observations, "physiology" ranges of the literature, "assumed" our choice.
/// Lengths of random motions are root mean squares of the 3-D displacement.
struct SimulationOptions {
  double rate_hz = 90;            ///< study: 90; 20 to 1000
  double least_duration_s = 4.0;  ///< study: 4 to 5 s; the duration is uniform between the two
  double most_duration_s = 5.0;
  HandCopy copy = HandCopy::automatic;  ///< assumed
  double mean_distance_m = 0.048;       ///< study: mean closest distance from stroke to target
  double slant_rad = 60 * std::numbers::pi / 180;  ///< assumed: of placed and turned copies
  double smoothing_m = 0.01;        ///< physiology: 1 to 2 cm; Gaussian deviation along the path
  double drift_m = 0.0025;          ///< physiology: 2 to 3 mm
  double least_drift_hz = 0.1;      ///< assumed
  double most_drift_hz = 0.9;       ///< physiology: below 1 Hz
  double tremor_m = 0.1e-3;         ///< physiology: 0.05 to 0.3 mm
  double least_tremor_hz = 8;       ///< physiology
  double most_tremor_hz = 12;       ///< physiology
  double noise_m = 0.06e-3;         ///< tracking: 0.02 to 0.3 mm, white
  double speed_exponent = 1.0 / 3;  ///< two-thirds power law: speed ~ curvature^(-1/3)
  double least_curvature = 2.0;     ///< 1/m, assumed: straighter parts are drawn no faster
  double start_m = 0.015;           ///< assumed: way to gather speed, and to stop
  double wobble_rad = 8 * std::numbers::pi / 180;  ///< study: of the controller's aim
  double least_wobble_hz = 0.1;                    ///< assumed
  double most_wobble_hz = 0.5;                     ///< assumed
  double start_error_m = 0.0;  ///< assumed: the hand's error when the trigger is pulled, kept
  double aimed_start_s = 0.5;  ///< assumed: drift and wobble grow from zero with this time constant
  double turn_tremor_rad = 0.1 * std::numbers::pi / 180;  ///< assumed; in the tremor's band
  double turn_noise_rad = 0.03 * std::numbers::pi / 180;  ///< assumed, white
  double head_distance_m = 0.45;                          ///< study: from head to tip, about
  double head_follow = 0.5;  ///< assumed: part of the hand's way that the body follows
  /// assumed: part of the gaze's way that the head turns after the tip; the eyes do the rest
  double head_turn = 1.0;
  Vec3 viewer = Vec3(0, 0.3, 1);  ///< assumed: where the drawer stands, seen from the target
  double facing_rad = 60 * std::numbers::pi / 180;  ///< assumed: beyond this the head moves around
  double most_head_turn_rad_per_s = 0.8;            ///< assumed: how fast it moves around the tip
  double feedback_delay_s = 0.15;        ///< physiology: from seeing an error to correcting it
  double feedback_gain_per_s = 4.0;      ///< physiology: part of the visible error removed a second
  double most_correction_m_per_s = 0.2;  ///< assumed: a jump of the ink is not chased faster
  /// assumed: ink that is farther off is on another part of the shape; of its error only what is
  /// seen, across the line of sight, is corrected, and as if it were no larger than this
  double most_corrected_m = 1000;
  /// assumed: part of a correction that is made by turning the controller, not by moving it; for
  /// techniques that spray. 0 to 1.
  double turned_correction = 0.0;
  /// assumed: part of the wobble's effect at the surface that the hand's place makes good, as
  /// people do who aim along the nozzle. 0 to 1.
  double coordination = 0.0;
  /// assumed: part of the way that is aimed at by turning the wrist: the hand's path is smaller by
  /// it. 0 to 0.9.
  double wrist_part = 0.0;
};

/// Where a technique inks for this frame (world), nothing on a miss. Called once for each frame, in
/// order.
using InkFunction = std::function<std::optional<Vec3>(const Frame& world)>;

/// A mid-air stroke as a person would draw it who means the curve `intended` on a target that
/// stands at model_to_world (y up, metres): the hand follows a smoothed copy of the curve at a
/// distance, faster where it is straight, with drift, tremor and tracking noise; the controller's
/// -z axis wobbles around the direction to the intended point; the head looks at the tip and moves
/// around where the surface turns away. The frames' mean closest distance to the target is
/// mean_distance_m. The intended curve is kept in the stroke, its name becomes the id. Equal
/// arguments give equal strokes; drift, tremor and noise are independent of each other's options.
///
/// Throws Error(invalid_input) where the curve has fewer than two points, no length or faces that
/// the target has not, where an option is out of range, or where the target's scale is not > 0.
/// About 10 ms.
Stroke simulate(const Target& target, const Intention& intended, const Similarity& model_to_world,
                const SimulationOptions& options, std::uint64_t seed);

/// The same in closed loop: the person sees the ink and removes the visible error (intended point
/// minus ink) with feedback_delay_s and feedback_gain_per_s. The mean distance is that of the
/// stroke without feedback.
Stroke simulate_closed_loop(const Target& target, const Intention& intended,
                            const Similarity& model_to_world, const SimulationOptions& options,
                            std::uint64_t seed, const InkFunction& ink);

}  // namespace mimicry
