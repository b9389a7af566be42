#pragma once

#include <span>
#include <string>
#include <string_view>

#include <mimicry/technique/technique.h>

namespace mimicry {

struct NoOptions {};

struct SightOptions {
  /// A pen inside the object draws at the surface that it went through, not where its ray leaves
  /// the far side. Of anchored techniques this is where a stroke starts. The paper's techniques do
  /// not.
  bool dipped_pen = false;
};

struct SprayOptions : SightOptions {
  /// Spray direction in the controller's own axes; any length above 0.
  Vec3 nozzle = -Vec3::UnitZ();
};

struct SmoothClosestOptions {
  /// Smooth points that fail the paper's test are replaced by closest points
  /// (ScpOptions). The paper's techniques do not.
  bool replace_failed = false;
};

struct SpraySmoothOptions : SprayOptions {
  bool replace_failed = false;  ///< as SmoothClosestOptions
};

/// An anchor that gives way: r - q, what the curve did not follow of the hand's motion, is carried
/// over to the next frame and fades. The paper's techniques have none.
struct SoftAnchorOptions : SprayOptions {
  bool soft_anchor = false;
  double soft_anchor_tau_s = 0.12;    ///< after which it has faded to 1/e
  double soft_anchor_limit_mm = 6.0;  ///< length carried at most, in the world
};

struct MimicryOptions : SoftAnchorOptions {
  bool replace_failed = false;  ///< as SmoothClosestOptions
};

/// An option's value in a block of its technique's options. Allocates nothing.
OptionValue read_option(const OptionInfo& option, const void* block);

/// Writes an option's default to the technique's block of them, for rows that are put together
/// while the program runs. Throws as `require_sound_option`, before anything is converted.
void set_default(TechniqueInfo& technique, const OptionInfo& option,
                 std::span<const double> values);

/// "snap: option 'dipped-pen'", with which refusals begin.
std::string option_label(const TechniqueInfo& technique, std::string_view option);

/// Throws Error(invalid_input) where a row's option lies outside its block or has a default that
/// cannot be set.
void require_sound_option(const TechniqueInfo& technique, const OptionInfo& option);

}  // namespace mimicry
