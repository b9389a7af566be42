#pragma once

#include <cstdint>
#include <functional>
#include <numbers>
#include <optional>
#include <span>
#include <vector>

#include <mimicry/spatial/target.h>
#include <mimicry/stroke/stroke.h>
#include <mimicry/study/recording.h>

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

/// A positive number that differs from person to person or from stroke to stroke: its logarithm is
/// normal.
struct Spread {
  double median;
  double log_deviation;
};

/// How people differ, and how they steer. "Study": seen in the paper's study; "physiology": ranges
/// of the literature; "assumed": our choice, tuned on half of the study's shapes
/// (docs/participants.md).
struct PopulationOptions {
  // From person to person.
  Spread pace = {1.0, 0.30};                ///< of all durations; study: tau's deviation
  Spread tremor_m = {0.09e-3, 0.60};        ///< physiology: 0.05 to 0.3 mm
  Spread noise_m = {0.040e-3, 0.40};        ///< tracking: 0.02 to 0.3 mm
  Spread turn_tremor_rad = {0.0056, 0.60};  ///< assumed; the same hand's tremor
  Spread distance_m = {0.046, 0.25};        ///< study: mean 4.8 cm from hand to surface
  Spread drift_m = {0.0010, 0.30};          ///< assumed: less than blind, the ink is watched
  Spread wobble_rad = {0.10, 0.30};    ///< study: about 8 degrees; assumed less, the ink is watched
  Spread gain_per_s = {4.0, 0.20};     ///< physiology: of corrections
  Spread delay_s = {0.15, 0.12};       ///< physiology
  Spread smoothing_m = {0.003, 0.25};  ///< assumed: less than blind
  Spread head_follow = {0.35, 0.25};   ///< assumed
  double head_turn = 0.28;             ///< assumed
  double standing_rad = 0.6;           ///< assumed: they walk to where the curve is seen, then draw
  double facing_rad = 1.1;             ///< assumed: beyond this they lean around the shape
  double most_head_turn_rad_per_s = 0.4;  ///< assumed: nobody walks fast while drawing
  // From stroke to stroke.
  double duration_s = 4.45;            ///< study: tau, of a curve of the length below
  double usual_length_m = 0.375;       ///< study: mean L_X
  double length_exponent = 0.5;        ///< assumed: longer curves are drawn faster (isochrony)
  double stroke_log_deviation = 0.20;  ///< assumed: of duration and distance
  double start_error_m = 0.4e-3;       ///< assumed: aiming at the first point with a cursor
  double most_corrected_m = 0.015;     ///< assumed: ink on another part of the shape is let be
  double slant_rad = 1.05;             ///< assumed: at which the surface is looked and aimed at
  double recalled_error = 0.0035;      ///< assumed: between keypoints, part of their distance
  double recalled_pace = 0.92;         ///< study: tau of re-creating by that of tracing
  // How a technique is steered.
  double aiming_turned_correction = 0.6;  ///< assumed: the wrist is quicker than the arm
  double aiming_coordination = 0.95;      ///< assumed: hand and wrist make up for each other
  double aiming_wrist = 0.15;             ///< assumed: part of the way drawn from the wrist
  double aiming_facing_rad = 1.0;         ///< assumed: facing_rad of who looks along the nozzle
  double aiming_head = 1.6;               ///< assumed: head_follow when aiming along the nozzle
  double aiming_slant_rad = 0.4;          ///< assumed: sprays blur, and rays jump, at a slant
  double moving_wobble = 1.0;             ///< assumed: the wrist rests where it does not count
  double moving_pace = 1.13;              ///< study: tau of mimicry by that of spraycan
};

/// One person; drawn from the options by `participant`.
struct Participant {
  std::uint64_t seed = 1;
  SimulationOptions hand;  ///< the person's own values
  double pace = 1.0;
};

/// The person of this number, the same whoever else takes part.
Participant participant(const PopulationOptions& options, std::uint64_t seed, Index number);

/// The order of a participant's study: every participant number gives the techniques in another of
/// `methods` rotations, and back to front every other time, so that over 2 x methods participants
/// each technique stands equally often at each place and before each other (counterbalanced);
/// shapes as given; for each shape its curves shuffled, the first half traced and its first
/// repeated, the second half re-created and its first repeated. curve_counts: for each shape, even
/// and at least 2; throws Error(invalid_input) otherwise.
StudySequence study_sequence(std::span<const Index> methods, std::span<const Index> shapes,
                             std::span<const Index> curve_counts, std::uint64_t seed, Index number);

/// What a person who recalls a curve by its keypoints means: the curve, moved sideways on the
/// surface between keypoints by `recalled_error` of their distance (root mean square), not at them.
Intention recalled(const Target& target, const Intention& curve, std::span<const Index> keypoints,
                   double recalled_error, std::uint64_t seed);

/// A person draws: the stroke of `trial_number` in the participant's whole study. The ink is seen
/// in either task: traced strokes are corrected toward the curve, re-created ones toward what is
/// recalled of it. keypoints: numbers of the curve's points; empty: its ends. The stroke's
/// intention is the curve itself. Errors and cost as `simulate_closed_loop`.
Stroke draw_trial(const Target& target, const Intention& curve, std::span<const Index> keypoints,
                  TaskKind task, const Similarity& model_to_world, const PopulationOptions& options,
                  const Participant& person, Steering steering, std::uint64_t trial_number,
                  const InkFunction& ink);

}  // namespace mimicry
