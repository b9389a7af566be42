#pragma once

#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <new>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include <mimicry/base/types.h>
#include <mimicry/embedding/smooth_projector.h>
#include <mimicry/mesh/triangle_mesh.h>
#include <mimicry/spatial/target.h>
#include <mimicry/stroke/stroke.h>

namespace mimicry {

/// Types that are copied by copying their bytes: trivially copyable ones, and those that hold
/// Eigen's vectors of fixed size. No pointers to themselves, nothing to give back.
template <class T>
inline constexpr bool kIsPlain =
    std::is_trivially_destructible_v<T>&& std::is_copy_constructible_v<T> &&
    alignof(T) <= alignof(std::uint64_t);

/// Plain data of a size that is known when it is made, and of a type that only its technique knows:
/// the options and the memory of a technique. Copies are deep; assigning a block of the same size
/// does not allocate.
class Block {
 public:
  Block() = default;
  /// Zeros.
  explicit Block(std::size_t bytes) : words_((bytes + 7) / 8), size_(bytes) {}
  template <class T>
  static Block of(const T& value) {
    static_assert(kIsPlain<T>, "the data of a technique must be plain");
    Block block(sizeof(T));
    new (block.data()) T(value);
    return block;
  }

  bool empty() const { return size_ == 0; }
  std::size_t size() const { return size_; }  ///< bytes
  void* data() { return words_.data(); }
  const void* data() const { return words_.data(); }

  /// T: the type that the block was made of.
  template <class T>
  T& as() {
    assert(sizeof(T) == size_);
    return *std::launder(static_cast<T*>(data()));
  }
  template <class T>
  const T& as() const {
    assert(sizeof(T) == size_);
    return *std::launder(static_cast<const T*>(data()));
  }

 private:
  std::vector<std::uint64_t> words_;
  std::size_t size_ = 0;
};

struct TechniqueInfo;

enum class OptionKind : std::uint8_t {
  boolean,    ///< bool
  number,     ///< double
  direction,  ///< three doubles, lowest to highest, not all zero
  choice,     ///< an enumeration of 32 bits, its values counted from 0
};

/// "boolean", "number", "direction", "choice".
std::string_view kind_name(OptionKind kind);

/// One option of a technique: what programs, files and people need to know of it, and where it lies
/// in the technique's block of options. Made by `option`.
struct OptionInfo {
  std::string name;  ///< lower case, words joined by "-"
  std::string unit;  ///< "s", "mm"; empty where there is none
  std::string description;
  OptionKind kind = OptionKind::number;
  double lowest = 0.0, highest = 1.0;  ///< of each number
  std::vector<std::string> choices;    ///< names of a choice's values
  std::size_t offset = 0;              ///< in the block, bytes
  /// Files of curves list it whatever its value is; else where it is not the default.
  bool always_listed = true;
};

/// What an option needs beside its name and member; see OptionInfo.
struct OptionDetails {
  std::string unit{};
  double lowest = 0.0, highest = 1.0;
  std::vector<std::string> choices{};
  bool always_listed = true;
};

/// A member of the struct of options as an option: bool, double, Vec3 or std::array<double, 3>, or
/// an enumeration of 32 bits with `choices`. The member may be a base's. Numbers are 0 to 1 where
/// nothing else is said, directions -1 to 1.
template <class OwnOptions, class Owner, class Value>
OptionInfo option(std::string name, Value Owner::*member, std::string description,
                  OptionDetails details = {}) {
  static_assert(std::is_base_of_v<Owner, OwnOptions>);
  const OwnOptions block{};
  OptionInfo info;
  info.name = std::move(name);
  info.description = std::move(description);
  info.unit = std::move(details.unit);
  info.lowest = details.lowest;
  info.highest = details.highest;
  info.always_listed = details.always_listed;
  info.offset = static_cast<std::size_t>(reinterpret_cast<const std::byte*>(&(block.*member)) -
                                         reinterpret_cast<const std::byte*>(&block));
  if constexpr (std::is_same_v<Value, bool>) {
    info.kind = OptionKind::boolean;
  } else if constexpr (std::is_same_v<Value, double>) {
    info.kind = OptionKind::number;
  } else if constexpr (std::is_enum_v<Value>) {
    static_assert(sizeof(Value) == sizeof(std::int32_t), "give the enumeration 32 bits");
    info.kind = OptionKind::choice;
    info.choices = std::move(details.choices);
    info.highest = static_cast<double>(info.choices.size()) - 1.0;
  } else {
    static_assert(sizeof(Value) == 3 * sizeof(double),
                  "an option is a bool, a double, a "
                  "direction or an enumeration");
    info.kind = OptionKind::direction;
    info.lowest = -1.0;
    info.highest = 1.0;
  }
  return info;
}

/// An option's value as numbers: 1, or the 3 of a direction. Booleans are 0 or 1, choices the
/// number of their value.
class OptionValue {
 public:
  OptionValue() = default;
  explicit OptionValue(double x) : numbers_{x} {}
  explicit OptionValue(const std::array<double, 3>& v) : numbers_(v), size_(3) {}
  const double* begin() const { return numbers_.data(); }
  const double* end() const { return numbers_.data() + size_; }
  std::size_t size() const { return size_; }
  double operator[](std::size_t i) const { return numbers_[i]; }
  friend bool operator==(const OptionValue&, const OptionValue&) = default;

 private:
  std::array<double, 3> numbers_{};
  std::size_t size_ = 1;
};

/// The options of one technique. As they are made they stand for the defaults of whatever
/// technique they are given to.
class TechniqueOptions {
 public:
  TechniqueOptions() = default;
  /// The technique's defaults, ready to be changed.
  explicit TechniqueOptions(const TechniqueInfo& technique);

  bool is_default() const { return block_.empty(); }
  /// The block for this technique's step; lives as long as both. Throws Error(invalid_input) where
  /// the options are another technique's.
  const Block& block(const TechniqueInfo& technique) const;
  Block& edit(const TechniqueInfo& technique);

 private:
  std::string technique_;
  Block block_;
};

/// Throws as `TechniqueOptions::block`.
OptionValue option_value(const TechniqueInfo& technique, const OptionInfo& option,
                         const TechniqueOptions& options);

/// Throws Error(invalid_input) naming technique and option where the technique has no such option,
/// the count of numbers is wrong, one is not finite or out of range, a boolean is neither 0 nor 1
/// or a choice is none of its values.
void set_option(const TechniqueInfo& technique, TechniqueOptions& options, std::string_view name,
                std::span<const double> values);

/// Whether files of curves that were drawn with these options list this one.
bool is_listed(const TechniqueInfo& technique, const OptionInfo& option,
               const TechniqueOptions& options);

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

/// The point for one frame; `surface` and `position` are set where `answer` is not miss. A session
/// takes one that is not on the mesh (its barycentric coordinates at least -1e-6, their sum 1
/// within 1e-6), or not finite, for a miss.
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
/// ends. An empty title is the name, an empty source "-". Throws Error(invalid_input) where the
/// name is taken or not written as names are, the step is missing, an option lies outside its
/// block, has a default out of range or the name of another one, or kMostRegistered are there.
/// Thread-safe.
const TechniqueInfo& register_technique(TechniqueInfo info);

}  // namespace mimicry
