#include "study/simulation_check.h"

#include <cmath>
#include <string>
#include <utility>

#include <mimicry/base/error.h>

#include "base/finite.h"

namespace mimicry {
namespace {

// False for NaN, which must not be compared: that trips the floating-point traps.
bool within(double value, double least, double most) {
  return std::isfinite(value) && value >= least && value <= most;
}

}  // namespace

void refuse_simulation(const std::string& what) {
  throw Error(ErrorKind::invalid_input, "simulate: " + what);
}

void check_simulation(const SimulationOptions& o) {
  if (!within(o.rate_hz, 20, 1000))
    refuse_simulation("rate_hz " + std::to_string(o.rate_hz) + " is not within 20 to 1000");
  if (!within(o.least_duration_s, 0.1, 600) || !within(o.most_duration_s, o.least_duration_s, 600))
    refuse_simulation("durations must be within 0.1 to 600 s, the least first");
  for (const auto& [value, name] : {std::pair{o.mean_distance_m, "mean_distance_m"},
                                    {o.smoothing_m, "smoothing_m"},
                                    {o.drift_m, "drift_m"},
                                    {o.tremor_m, "tremor_m"},
                                    {o.noise_m, "noise_m"},
                                    {o.wobble_rad, "wobble_rad"},
                                    {o.turn_tremor_rad, "turn_tremor_rad"},
                                    {o.turn_noise_rad, "turn_noise_rad"},
                                    {o.speed_exponent, "speed_exponent"},
                                    {o.start_m, "start_m"},
                                    {o.start_error_m, "start_error_m"},
                                    {o.aimed_start_s, "aimed_start_s"},
                                    {o.head_distance_m, "head_distance_m"},
                                    {o.facing_rad, "facing_rad"},
                                    {o.most_head_turn_rad_per_s, "most_head_turn_rad_per_s"},
                                    {o.feedback_delay_s, "feedback_delay_s"},
                                    {o.feedback_gain_per_s, "feedback_gain_per_s"},
                                    {o.most_correction_m_per_s, "most_correction_m_per_s"},
                                    {o.most_corrected_m, "most_corrected_m"},
                                    {o.slant_rad, "slant_rad"},
                                    {o.least_drift_hz, "least_drift_hz"},
                                    {o.most_drift_hz, "most_drift_hz"},
                                    {o.least_tremor_hz, "least_tremor_hz"},
                                    {o.most_tremor_hz, "most_tremor_hz"},
                                    {o.least_wobble_hz, "least_wobble_hz"},
                                    {o.most_wobble_hz, "most_wobble_hz"}})
    if (!within(value, 0, 1000)) refuse_simulation(std::string(name) + " is not within 0 to 1000");
  if (!within(o.turned_correction, 0, 1))
    refuse_simulation("turned_correction is not within 0 to 1");
  if (!within(o.head_follow, 0, 1)) refuse_simulation("head_follow is not within 0 to 1");
  if (!within(o.head_turn, 0, 1)) refuse_simulation("head_turn is not within 0 to 1");
  if (!within(o.wrist_part, 0, 0.9)) refuse_simulation("wrist_part is not within 0 to 0.9");
  if (!within(o.coordination, 0, 1)) refuse_simulation("coordination is not within 0 to 1");
  if (!within(o.least_curvature, 1e-9, 1e9))
    refuse_simulation("least_curvature is not within 1e-9 to 1e9");
  if (!is_finite(o.viewer) || o.viewer.norm() < 1e-9)
    refuse_simulation("viewer must be a direction");
}

}  // namespace mimicry
