#include "technique/rows.h"

#include "technique/steps.h"

namespace mimicry {
namespace {

template <class TechniqueOptions>
OptionInfo dipped_pen() {
  return option<TechniqueOptions>(
      "dipped-pen", &TechniqueOptions::dipped_pen,
      "a pen inside the object draws at the surface it went through, not at the "
      "ray's first hit",
      {.always_listed = false});
}
template <class TechniqueOptions>
OptionInfo nozzle() {
  return option<TechniqueOptions>("nozzle", &TechniqueOptions::nozzle,
                                  "spray direction in the controller's axes (x,y,z)");
}
template <class TechniqueOptions>
OptionInfo replace_failed() {
  return option<TechniqueOptions>(
      "replace-failed", &TechniqueOptions::replace_failed,
      "smooth points that fail the paper's test are replaced by closest points");
}

template <class TechniqueOptions>
std::vector<OptionInfo> spray_options() {
  return {nozzle<TechniqueOptions>(), dipped_pen<TechniqueOptions>()};
}
std::vector<OptionInfo> spray_smooth_options() {
  using TechniqueOptions = SpraySmoothOptions;
  return {nozzle<TechniqueOptions>(), dipped_pen<TechniqueOptions>(),
          replace_failed<TechniqueOptions>()};
}
template <class TechniqueOptions>
std::vector<OptionInfo> soft_anchor_options() {
  return {nozzle<TechniqueOptions>(), dipped_pen<TechniqueOptions>(),
          option<TechniqueOptions>("soft-anchor", &TechniqueOptions::soft_anchor,
                                   "carry over what the curve did not follow"),
          option<TechniqueOptions>("soft-anchor-tau", &TechniqueOptions::soft_anchor_tau_s,
                                   "time in which what is carried over fades to 1/e",
                                   {.unit = "s", .lowest = 0.001, .highest = 10.0}),
          option<TechniqueOptions>("soft-anchor-limit", &TechniqueOptions::soft_anchor_limit_mm,
                                   "length carried over at most, in the world",
                                   {.unit = "mm", .lowest = 0.0, .highest = 100.0})};
}
std::vector<OptionInfo> mimicry_options() {
  std::vector<OptionInfo> options = soft_anchor_options<MimicryOptions>();
  options.push_back(replace_failed<MimicryOptions>());
  return options;
}

template <class TechniqueStep>
TechniqueInfo with_step(TechniqueInfo info, TechniqueStep step) {
  info.set_step(step);
  return info;
}

std::vector<TechniqueInfo> context_free_rows() {
  using enum Steering;
  return {
      with_step({.name = "occlude",
                 .title = "Occlude",
                 .sentence = "Draws on what the pen hides from your eye.",
                 .description =
                     "along the line of sight: from the eye through the pen, to what the pen hides",
                 .source = "3.1.1",
                 .color = 0x576aff,
                 .steering = moves,
                 .rank = 9,
                 .options = {dipped_pen<SightOptions>()}},
                occlude),
      with_step(
          {.name = "spraycan",
           .title = "Spraycan",
           .sentence = "Sprays along the direction in which you point, like a can of paint.",
           .description = "along the controller's nozzle, as from a spray can or a laser pointer",
           .source = "3.1.1",
           .color = 0xd55e00,
           .steering = aims,
           .rank = 8,
           .options = spray_options<SprayOptions>()},
          spraycan),
      with_step({.name = "head-centric",
                 .title = "Head-centric",
                 .sentence = "Draws where your head looks, whatever the hand does. On a screen you "
                             "look where the pointer is.",
                 .description = "along the head's forward axis: the curve is drawn by looking",
                 .source = "3.1.1",
                 .color = 0x7d6f3c,
                 .steering = moves,
                 .rank = 10,
                 .screen_note = "it needs a head that moves"},
                head_centric),
      with_step({.name = "snap",
                 .title = "Snap",
                 .sentence = "Draws at the closest point of the model to the pen.",
                 .description = "to the closest point of the surface",
                 .source = "3.1.2",
                 .color = 0xcaa2ff,
                 .steering = moves,
                 .rank = 11},
                snap),
      with_step({.name = "snap-smooth",
                 .title = "Snap smooth",
                 .sentence = "Draws at the smooth closest point to the pen: no jumps at ridges.",
                 .description = "to the smooth closest point of the surface",
                 .source = "3.1.2",
                 .color = 0x442567,
                 .steering = moves,
                 .needs_bake = true,
                 .rank = 12,
                 .options = {replace_failed<SmoothClosestOptions>()}},
                snap_smooth),
  };
}

std::vector<TechniqueInfo> smooth_rows() {
  using enum Steering;
  return {
      with_step({.name = "mimicry",
                 .title = "Mimicry",
                 .sentence = "Follows your hand through smooth closest points.",
                 .description =
                     "the hand's motion is added to the last point, then the smooth closest point",
                 .source = "Eq. mimicry",
                 .color = 0x0072b2,
                 .steering = moves,
                 .anchored = true,
                 .needs_bake = true,
                 .rank = 1,
                 .options = mimicry_options()},
                mimicry),
      with_step(
          {.name = "mimicry-planar",
           .title = "Mimicry planar",
           .sentence = "Follows your hand within the plane of your last two motions. Made for "
                       "hands in space: on a screen it may draw little.",
           .description =
               "along the surface's section with the plane of the hand's last two motions",
           .source = "4.2",
           .color = 0x0000f9,
           .steering = moves,
           .anchored = true,
           .rank = 2,
           .screen_note = "it needs a hand that moves in space, and a pen on a screen hardly does",
           .options = spray_options<SprayOptions>()},
          mimicry_planar),
      with_step(
          {.name = "mimicry-offset",
           .title = "Mimicry offset",
           .sentence = "Follows your hand but for motion toward the surface, seen from the pen.",
           .description =
               "as mimicry, without the motion toward or from the surface below the hand",
           .source = "Eq. offset",
           .color = 0x00788d,
           .steering = moves,
           .anchored = true,
           .needs_bake = true,
           .rank = 3,
           .options = spray_smooth_options()},
          mimicry_offset),
      with_step(
          {.name = "mimicry-parallel",
           .title = "Mimicry parallel",
           .sentence = "Follows your hand but for motion toward the surface, seen from the ink.",
           .description = "as mimicry, without the motion toward or from the surface at the curve",
           .source = "Eq. parallel",
           .color = 0x165e3c,
           .steering = moves,
           .anchored = true,
           .needs_bake = true,
           .rank = 4,
           .options = spray_smooth_options()},
          mimicry_parallel),
  };
}

TechniqueInfo anchored_closest_row() {
  return with_step(
      {.name = "anchored-closest",
       .title = "Anchored closest",
       .sentence = "Carries the motion of your hand to the ink, then takes the closest point.",
       .description = "the hand's motion is added to the last point, then the closest point",
       .source = "4.1",
       .color = 0xe69f00,
       .anchored = true,
       .rank = 5,
       .options = spray_options<SprayOptions>()},
      anchored_closest);
}

std::vector<TechniqueInfo> ray_and_live_rows() {
  return {
      with_step({.name = "anchored-ray-plane",
                 .title = "Anchored ray, plane",
                 .sentence = "Moves with your hand, then looks along a ray square to the motion.",
                 .description = "a ray across the motion, in its plane with the last ray",
                 .source = "4.3",
                 .color = 0x95c86c,
                 .anchored = true,
                 .rank = 6,
                 .options = spray_options<SprayOptions>()},
                anchored_ray_plane),
      with_step({.name = "anchored-ray-transport",
                 .title = "Anchored ray, transport",
                 .sentence = "Moves with your hand, and the ray to the surface turns with it.",
                 .description = "the last ray's direction, turned as the motion turned",
                 .source = "4.3",
                 .color = 0x7a2800,
                 .anchored = true,
                 .rank = 7,
                 .options = spray_options<SprayOptions>()},
                anchored_ray_transport),
      with_step({.name = "mimicry-live",
                 .title = "Mimicry live",
                 .sentence = "Follows your hand smoothly, wherever you hold it. Works at once.",
                 .description = "the hand's motion is added to the last point, then back along the "
                                "smoothed normal; no bake",
                 .source = "-",
                 .color = 0x009e73,
                 .anchored = true,
                 .rank = 0,
                 .options = soft_anchor_options<SoftAnchorOptions>()},
                mimicry_live),
  };
}

}  // namespace

std::vector<TechniqueInfo> built_in_techniques() {
  std::vector<TechniqueInfo> rows = context_free_rows();
  rows.push_back(anchored_closest_row());
  for (TechniqueInfo& row : smooth_rows()) rows.push_back(std::move(row));
  for (TechniqueInfo& row : ray_and_live_rows()) rows.push_back(std::move(row));
  return rows;
}

}  // namespace mimicry
