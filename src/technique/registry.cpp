#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include <mimicry/base/error.h>
#include <mimicry/technique/technique.h>

#include "technique/steps.h"

namespace mimicry::technique {
namespace {

constexpr OptionInfo kNozzle = {
    "nozzle",
    "",
    "spray direction in the controller's axes (x,y,z)",
    [](const Options& o) { return std::span<const double>(o.nozzle.data(), 3); },
    [](Options& o) { return std::span<double>(o.nozzle.data(), 3); },
    -1.0,
    1.0};

constexpr OptionInfo kDippedPen = {
    "dipped-pen",
    "",
    "1: a pen inside the object draws at the surface it went through; 0: at the ray's first hit",
    [](const Options& o) { return std::span<const double>(&o.dipped_pen, 1); },
    [](Options& o) { return std::span<double>(&o.dipped_pen, 1); },
    0.0,
    1.0,
    false};

constexpr std::array<OptionInfo, 1> kSightOptions = {kDippedPen};
constexpr std::array<OptionInfo, 2> kSprayOptions = {kNozzle, kDippedPen};

constexpr OptionInfo kReplaceFailed = {
    "replace-failed",
    "",
    "1: smooth points that fail the paper's test are replaced by closest points; 0: they stay",
    [](const Options& o) { return std::span<const double>(&o.replace_failed, 1); },
    [](Options& o) { return std::span<double>(&o.replace_failed, 1); },
    0.0,
    1.0};

constexpr std::array<OptionInfo, 1> kSmoothOptions = {kReplaceFailed};
constexpr std::array<OptionInfo, 3> kSpraySmoothOptions = {kNozzle, kDippedPen, kReplaceFailed};

constexpr std::array<OptionInfo, 6> kMimicryOptions = {{
    kNozzle,
    kDippedPen,
    {"soft-anchor", "", "1: carry over what the curve did not follow; 0: do not",
     [](const Options& o) { return std::span<const double>(&o.soft_anchor.on, 1); },
     [](Options& o) { return std::span<double>(&o.soft_anchor.on, 1); }, 0.0, 1.0},
    {"soft-anchor-tau", "s", "time in which what is carried over fades to 1/e",
     [](const Options& o) { return std::span<const double>(&o.soft_anchor.tau_s, 1); },
     [](Options& o) { return std::span<double>(&o.soft_anchor.tau_s, 1); }, 0.001, 10.0},
    {"soft-anchor-limit", "mm", "length carried over at most, in the world",
     [](const Options& o) { return std::span<const double>(&o.soft_anchor.limit_mm, 1); },
     [](Options& o) { return std::span<double>(&o.soft_anchor.limit_mm, 1); }, 0.0, 100.0},
    kReplaceFailed,
}};
// The same without what it does not have.
constexpr std::array<OptionInfo, 5> kLiveOptions = {kMimicryOptions[0], kMimicryOptions[1],
                                                    kMimicryOptions[2], kMimicryOptions[3],
                                                    kMimicryOptions[4]};

constexpr std::array<TechniqueInfo, 13> kTechniques = {{
    {"occlude", "along the line of sight: from the eye through the pen, to what the pen hides",
     "3.1.1", false, false, kSightOptions, occlude},
    {"spraycan", "along the controller's nozzle, as from a spray can or a laser pointer", "3.1.1",
     false, false, kSprayOptions, spraycan},
    {"head-centric",
     "along the head's forward axis: the curve is drawn by looking",
     "3.1.1",
     false,
     false,
     {},
     head_centric},
    {"snap", "to the closest point of the surface", "3.1.2", false, false, {}, snap},
    {"snap-smooth", "to the smooth closest point of the surface", "3.1.2", false, true,
     kSmoothOptions, snap_smooth},
    {"anchored-closest", "the hand's motion is added to the last point, then the closest point",
     "4.1", true, false, kSprayOptions, anchored_closest},
    {"mimicry", "the hand's motion is added to the last point, then the smooth closest point",
     "Eq. mimicry", true, true, kMimicryOptions, mimicry},
    {"mimicry-planar", "along the surface's section with the plane of the hand's last two motions",
     "4.2", true, false, kSprayOptions, mimicry_planar},
    {"mimicry-offset", "as mimicry, without the motion toward or from the surface below the hand",
     "Eq. offset", true, true, kSpraySmoothOptions, mimicry_offset},
    {"mimicry-parallel", "as mimicry, without the motion toward or from the surface at the curve",
     "Eq. parallel", true, true, kSpraySmoothOptions, mimicry_parallel},
    {"anchored-ray-plane", "a ray across the motion, in its plane with the last ray", "4.3", true,
     false, kSprayOptions, anchored_ray_plane},
    {"anchored-ray-transport", "the last ray's direction, turned as the motion turned", "4.3", true,
     false, kSprayOptions, anchored_ray_transport},
    {"mimicry-live",
     "the hand's motion is added to the last point, then back along the smoothed normal; no bake",
     "-", true, false, kLiveOptions, mimicry_live},
}};

}  // namespace

std::string_view answer_name(Answer answer) {
  constexpr std::array<std::string_view, kAnswerCount> kNames = {
      "miss",    "ray",           "closest",           "smooth",
      "section", "outside-shell", "no-phong-solution", "replaced"};
  return kNames[static_cast<std::size_t>(answer)];
}

bool is_listed(const OptionInfo& option, const Options& options) {
  const Options defaults;
  const auto values = option.get(options), usual = option.get(defaults);
  return option.always_listed || !std::equal(values.begin(), values.end(), usual.begin());
}

std::span<const TechniqueInfo> techniques() {
  return kTechniques;
}

const TechniqueInfo& find_technique(std::string_view name) {
  std::string names;
  for (const TechniqueInfo& t : kTechniques) {
    if (t.name == name) return t;
    names += (names.empty() ? "" : ", ") + std::string(t.name);
  }
  throw Error(ErrorKind::invalid_input,
              "technique '" + std::string(name) + "' does not exist; choose one of " + names);
}

void set_option(const TechniqueInfo& technique, Options& options, std::string_view name,
                std::span<const double> values) {
  const std::string label = std::string(technique.name) + ": option '" + std::string(name) + "'";
  std::string names;
  for (const OptionInfo& info : technique.options) {
    if (info.name != name) {
      names += (names.empty() ? "" : ", ") + std::string(info.name);
      continue;
    }
    const std::span<double> stored = info.edit(options);
    if (values.size() != stored.size())
      throw Error(ErrorKind::invalid_input, label + " takes " + std::to_string(stored.size()) +
                                                " numbers, not " + std::to_string(values.size()));
    double largest = 0.0;
    for (const double v : values) {
      if (!std::isfinite(v) || v < info.lowest || v > info.highest)
        throw Error(ErrorKind::invalid_input, label + ": " + std::to_string(v) +
                                                  " is not between " + std::to_string(info.lowest) +
                                                  " and " + std::to_string(info.highest));
      largest = std::max(largest, std::abs(v));
    }
    if (values.size() == 3 && largest == 0.0)
      throw Error(ErrorKind::invalid_input, label + " is a direction and cannot be zero");
    std::copy(values.begin(), values.end(), stored.begin());
    return;
  }
  throw Error(
      ErrorKind::invalid_input,
      label + " does not exist; " + (names.empty() ? "it has none" : "its options are " + names));
}

}  // namespace mimicry::technique
