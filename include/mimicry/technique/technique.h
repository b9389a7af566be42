#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <mimicry/embedding/smooth_projector.h>
#include <mimicry/mesh/surface_point.h>
#include <mimicry/spatial/target.h>
#include <mimicry/stroke/frame.h>
#include <mimicry/stroke/steering.h>
#include <mimicry/technique/block.h>
#include <mimicry/technique/option.h>

namespace mimicry {

/// What a technique may look at: the target and what was prepared for it. It keeps both alive.
struct Canvas {
  Target target;
  double metres_per_unit = 1.0;  ///< at which the target is shown; > 0; a session sets its own
  /// For techniques that need a bake (`TechniqueInfo::needs_bake`), of the same target; else empty.
  SmoothProjector projector = {};
};

/// How a point was found.
enum class Answer : std::uint8_t {
  miss,     ///< there is none
  ray,      ///< first hit of a ray
  closest,  ///< closest point of the surface
  smooth,   ///< a smooth projection
  section,  ///< end of a walk along the surface, or closest point of a section of it
  // Closest points in place of smooth ones (ScpLabel).
  outside_shell,
  no_phong_solution,
  replaced,
};

inline constexpr std::size_t kAnswerCount = 8;
/// One or two words, joined by "-": "smooth", "no-phong-solution".
std::string_view answer_name(Answer answer);

/// The point for one frame; `surface` and `position` are set where `answer` is not miss.
struct TechniqueStep {
  Answer answer = Answer::miss;
  SurfacePoint surface;
  Vec3 position = Vec3::Zero();
};

/// What a technique carries from frame to frame, in model space: plain data of its own. A stroke
/// starts with a copy of `TechniqueInfo::first_memory`; copying it is all there is to undo a frame.
using TechniqueMemory = Block;

/// frame: model space, usable (`is_usable`). options, memory: the technique's own blocks;
/// the memory is replaced by what to carry to the next frame. Depends on its arguments alone: no
/// clock, no globals, no allocation. May be called from several threads with memories of their
/// own.
using StepFunction = std::function<TechniqueStep(const Canvas&, const Frame& frame,
                                                 const void* options, void* memory)>;

/// What a typed step gives back: the point, and what to carry to the next frame.
template <class OwnMemory>
struct Stepped : TechniqueStep {
  OwnMemory memory;
};

/// A technique: all that sessions, programs and people need to know of it.
struct TechniqueInfo {
  std::string name{};              ///< lower case letters and digits, words joined by "-"
  std::string title{};             ///< for people
  std::string sentence{};          ///< for someone who has never read of it
  std::string description{};       ///< one line, exact
  std::string source{};            ///< section or equation of the paper, "-" where there is none
  std::uint32_t color = 0x777777;  ///< sRGB, 0xrrggbb, of its curves in documents and pictures
  Steering steering = Steering::moves;
  bool anchored = false;    ///< looks at the last point too, not at the frame alone
  bool needs_bake = false;  ///< needs an embedding of the target
  int rank = 100;           ///< those of lower rank are offered to people first
  std::string
      screen_note{};  ///< why a pen on a screen draws little with it; empty where it does not
  std::vector<OptionInfo> options{};
  Block default_options{};  ///< the size of this block is that of all blocks of its options
  Block first_memory{};     ///< the same of its memory
  StepFunction step{};

  /// Takes a typed step: OwnOptions{} are the defaults, OwnMemory{} is a stroke's first memory.
  /// Both are plain (kIsPlain).
  template <class OwnMemory, class OwnOptions>
  void set_step(Stepped<OwnMemory> (*typed)(const Canvas&, const OwnMemory&, const Frame&,
                                            const OwnOptions&)) {
    default_options = Block::of(OwnOptions{});
    first_memory = Block::of(OwnMemory{});
    step = [typed](const Canvas& canvas, const Frame& frame, const void* own_options,
                   void* memory) -> TechniqueStep {
      OwnMemory& own_memory = *static_cast<OwnMemory*>(memory);
      const Stepped<OwnMemory> stepped =
          typed(canvas, own_memory, frame, *static_cast<const OwnOptions*>(own_options));
      own_memory = stepped.memory;
      return stepped;
    };
  }
};

/// All techniques: those of the paper and ours in the order of their documentation, then those
/// that were registered. They live as long as the program.
std::span<const TechniqueInfo> techniques();

/// nullptr where there is no such technique.
const TechniqueInfo* technique_named(std::string_view name);

/// Throws Error(invalid_input) with the list of names for one that is not in it.
const TechniqueInfo& find_technique(std::string_view name);

/// How many techniques can be registered.
inline constexpr std::size_t kMostRegistered = 200;

/// Adds a technique to those that sessions, files and programs know by name, until the program
/// ends. An empty title is the name. Throws Error(invalid_input) where the name is taken or not
/// written as names are, the step is missing, an option lies outside its block, has a default out
/// of range or the name of another one, or kMostRegistered are there. Thread-safe.
const TechniqueInfo& register_technique(TechniqueInfo info);

}  // namespace mimicry
