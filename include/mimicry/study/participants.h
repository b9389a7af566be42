#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <mimicry/stroke/steering.h>
#include <mimicry/study/protocol.h>
#include <mimicry/study/simulate.h>

namespace mimicry {

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
