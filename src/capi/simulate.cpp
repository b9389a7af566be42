#include <mimicry/study/simulate.h>

#include "capi/handles.h"
#include "study/simulation_mark.h"

using namespace mimicry;
using namespace mimicry::capi;

namespace {

// Both ways in one list: what the structure has of the options.
template <class From, class To>
void copy_options(const From& from, To& to) {
  to.rate_hz = from.rate_hz;
  to.least_duration_s = from.least_duration_s;
  to.most_duration_s = from.most_duration_s;
  to.mean_distance_m = from.mean_distance_m;
  to.smoothing_m = from.smoothing_m;
  to.drift_m = from.drift_m;
  to.tremor_m = from.tremor_m;
  to.noise_m = from.noise_m;
  to.wobble_rad = from.wobble_rad;
  to.start_error_m = from.start_error_m;
  to.turn_tremor_rad = from.turn_tremor_rad;
  to.turn_noise_rad = from.turn_noise_rad;
  to.head_distance_m = from.head_distance_m;
  to.head_follow = from.head_follow;
  to.feedback_delay_s = from.feedback_delay_s;
  to.feedback_gain_per_s = from.feedback_gain_per_s;
  to.copy = static_cast<decltype(to.copy)>(from.copy);
}

static_assert(static_cast<int>(HandCopy::automatic) == MIMICRY_COPY_AUTOMATIC &&
              static_cast<int>(HandCopy::turned) == MIMICRY_COPY_TURNED);

SimulationOptions options_of(const mimicry_simulation_options* given) {
  SimulationOptions options;
  if (!given) return options;
  if (given->copy < MIMICRY_COPY_AUTOMATIC || given->copy > MIMICRY_COPY_TURNED)
    throw Error(ErrorKind::invalid_input, "copy is " +
                                              std::to_string(static_cast<int>(given->copy)) +
                                              ", which is none of mimicry_hand_copy");
  copy_options(*given, options);
  return options;
}

}  // namespace

mimicry_simulation_options mimicry_default_simulation_options(void) {
  mimicry_simulation_options out{};
  copy_options(SimulationOptions{}, out);
  return out;
}

mimicry_status mimicry_strokes_simulate(mimicry_strokes* strokes, const mimicry_target* target,
                                        const char* technique, const char* id,
                                        const char* target_name,
                                        const mimicry_similarity* model_to_world,
                                        const mimicry_surface_point* intended,
                                        size_t intended_count,
                                        const mimicry_simulation_options* options, uint32_t seed) {
  return guarded([&] {
    require(strokes, "strokes");
    require(target, "target");
    const Target& t = *target->target;
    const Intention meant{std::string(text(id, "id")), false,
                          to_points(t, intended, intended_count, "intended point")};
    const Similarity placed = to_similarity(model_to_world);
    const SimulationOptions chosen = options_of(options);
    Stroke stroke;
    std::string seen;
    if (technique) {
      const TechniqueInfo& row = usable_technique(*target, technique);
      StrokeSession session(canvas_of(*target), row);
      session.begin(placed);
      stroke = simulate_closed_loop(t, meant, placed, chosen, seed,
                                    [&](const Frame& frame) { return session.ink(frame); });
      seen = row.name;
    } else {
      stroke = simulate(t, meant, placed, chosen, seed);
    }
    stroke.target = target_name ? target_name : target->view->name;
    stroke.simulated = simulation_mark(seed, seen);
    strokes->strokes.push_back(std::move(stroke));
  });
}
