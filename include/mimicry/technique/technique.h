#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include <mimicry/embedding/smooth_projector.h>
#include <mimicry/mesh/surface_point.h>
#include <mimicry/spatial/target.h>
#include <mimicry/stroke/frame.h>

namespace mimicry::technique {

/// What a technique may look at: the target and what was prepared for it.
struct Canvas {
  const spatial::Target* target = nullptr;
  double metres_per_unit = 1.0;  ///< at which the target is shown; > 0; a session sets its own
  /// For techniques that need a bake (`TechniqueInfo::needs_bake`); of the same target.
  const embedding::SmoothProjector* projector = nullptr;
};

/// How a point was found.
enum class Answer : std::uint8_t {
  miss,     ///< there is none
  ray,      ///< first hit of a ray
  closest,  ///< closest point of the surface
  smooth,   ///< a smooth projection
  section,  ///< end of a walk along the surface, or closest point of a section of it
  // Closest points in place of smooth ones (embedding::ScpLabel).
  outside_shell,
  no_phong_solution,
  replaced,
};

inline constexpr std::size_t kAnswerCount = 8;
/// One or two words, joined by "-": "smooth", "no-phong-solution".
std::string_view answer_name(Answer answer);

/// What is carried from frame to frame, in model space. The anchor is the last frame that had a
/// point. A stroke starts with Memory{}. Plain data: copying it is all there is to undo a frame.
struct Memory {
  bool anchored = false;          ///< there is an anchor: the first point was found
  Vec3 pen = Vec3::Zero();        ///< the anchor's p
  SurfacePoint surface;           ///< the anchor's q; also a hint where to search
  Vec3 position = Vec3::Zero();   ///< the same in space
  double time_s = 0.0;            ///< of the anchor's frame
  Vec3 rest = Vec3::Zero();       ///< of the soft anchor: r - q of the anchor's frame
  Index points = 0;               ///< found, not counting those of a pen at rest
  Vec3 motion = Vec3::Zero();     ///< the last motion of the pen that was not zero
  Vec3 direction = Vec3::Zero();  ///< the last plane's normal or ray's direction; zero: none yet
  Index tet = kNone;              ///< a hint where to search in the shell
};

/// An anchor that gives way: r - q, what the curve did not follow of the hand's motion, is carried
/// over to the next frame and fades. Numbers, so that programs can set them by name.
struct SoftAnchor {
  double on = 0.0;        ///< 0 or 1; the paper's techniques have none
  double tau_s = 0.12;    ///< after which it has faded to 1/e
  double limit_mm = 6.0;  ///< length carried at most, in the world
};

struct Options {
  /// Spray direction in the controller's own axes; any length above 0.
  Vec3 nozzle = -Vec3::UnitZ();
  SoftAnchor soft_anchor;
  /// 0 or 1: smooth points that fail the paper's test are replaced by closest points
  /// (embedding::ScpOptions). The paper's techniques do not.
  double replace_failed = 0.0;
  /// 0 or 1: a pen inside the object draws at the surface that it went through, not where its ray
  /// leaves the far side. Of anchored techniques this is where a stroke starts. The paper's
  /// techniques do not.
  double dipped_pen = 0.0;
};

/// The point for one frame, and what to carry to the next. `surface` and `position` are set where
/// `answer` is not miss; a miss leaves the memory as it was.
struct Step {
  Answer answer = Answer::miss;
  SurfacePoint surface;
  Vec3 position = Vec3::Zero();
  Memory memory;
};

/// frame: model space, usable (`stroke::is_usable`). Pure: no clock, no globals, no
/// allocation.
using StepFunction = Step (*)(const Canvas&, const Memory&, const stroke::Frame&, const Options&);

/// An option by name, for programs and files; the values are 1 number or the 3 of a vector.
struct OptionInfo {
  std::string_view name;
  std::string_view unit;
  std::string_view description;
  std::span<const double> (*get)(const Options&);
  std::span<double> (*edit)(Options&);
  double lowest, highest;  ///< of each number
  /// Files of curves list it whatever its value is; else where it is not the default.
  bool always_listed = true;
};

/// Whether files of curves that were drawn with these options list this one.
bool is_listed(const OptionInfo& option, const Options& options);

struct TechniqueInfo {
  std::string_view name;
  std::string_view description;  ///< one line
  std::string_view source;       ///< section or equation of the paper
  bool anchored;                 ///< looks at the anchor too, not at the frame alone
  bool needs_bake;               ///< needs an embedding of the target
  std::span<const OptionInfo> options;
  StepFunction step;
};

/// All techniques, in the order of their documentation.
std::span<const TechniqueInfo> techniques();

/// Throws Error(invalid_input) with the list of names for one that is not in it.
const TechniqueInfo& find_technique(std::string_view name);

/// Throws Error(invalid_input) naming technique and option where the technique has no such option,
/// the count of numbers is wrong, or one is not finite or out of range.
void set_option(const TechniqueInfo& technique, Options& options, std::string_view name,
                std::span<const double> values);

}  // namespace mimicry::technique
