#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include <mimicry/base/types.h>
#include <mimicry/technique/block.h>

namespace mimicry {

struct TechniqueInfo;

enum class OptionKind : std::uint8_t {
  boolean,    ///< bool
  number,     ///< double
  direction,  ///< three doubles, not all zero; of any length
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

/// A member of the block `Block` as an option: bool, double, Vec3 or std::array<double, 3>, or an
/// enumeration of 32 bits with `choices`. The member may be a base's. Numbers are 0 to 1 where
/// nothing else is said, directions -1 to 1.
template <class TechniqueOptions, class Owner, class Value>
OptionInfo option(std::string name, Value Owner::*member, std::string description,
                  OptionDetails details = {}) {
  static_assert(std::is_base_of_v<Owner, TechniqueOptions>);
  const TechniqueOptions block{};
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

/// TechniqueOptions of one technique. As they are made they stand for the defaults of whatever
/// technique they are given to.
class TechniqueOptions {
 public:
  TechniqueOptions() = default;
  /// The technique's defaults, ready to be changed.
  explicit TechniqueOptions(const TechniqueInfo& technique);

  bool is_default() const { return block_.empty(); }
  /// Whose they are; empty where they are the defaults.
  const std::string& technique() const { return technique_; }
  /// The block for this technique's step; lives as long as both. Throws Error(invalid_input) where
  /// the options are another technique's.
  const Block& block(const TechniqueInfo& technique) const;
  Block& edit(const TechniqueInfo& technique);
  /// For who knows the technique's own type.
  template <class T>
  T& as() {
    return block_.as<T>();
  }

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

}  // namespace mimicry
