#include "technique/options.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>

#include <mimicry/base/error.h>
#include <mimicry/technique/technique.h>

#include "base/comma_list.h"

namespace mimicry {

OptionValue read_option(const OptionInfo& info, const void* block) {
  const char* at = static_cast<const char*>(block) + info.offset;
  switch (info.kind) {
    case OptionKind::boolean:
      return OptionValue(*at != 0 ? 1.0 : 0.0);
    case OptionKind::direction: {
      std::array<double, 3> v;
      std::memcpy(v.data(), at, sizeof v);
      return OptionValue(v);
    }
    case OptionKind::choice: {
      std::int32_t number;
      std::memcpy(&number, at, sizeof number);
      return OptionValue(number);
    }
    case OptionKind::number:
      break;
  }
  double x;
  std::memcpy(&x, at, sizeof x);
  return OptionValue(x);
}

namespace {

void write(const OptionInfo& info, Block& block, std::span<const double> values) {
  char* at = static_cast<char*>(block.data()) + info.offset;
  if (info.kind == OptionKind::boolean) {
    *at = values[0] != 0.0 ? 1 : 0;
  } else if (info.kind == OptionKind::choice) {
    const auto number = static_cast<std::int32_t>(values[0]);
    std::memcpy(at, &number, sizeof number);
  } else {
    std::memcpy(at, values.data(), values.size_bytes());
  }
}

// What is wrong with a value; empty where nothing is.
std::string fault(const OptionInfo& info, std::span<const double> values) {
  const std::size_t count = info.kind == OptionKind::direction ? 3 : 1;
  if (values.size() != count)
    return " takes " + std::to_string(count) + (count == 1 ? " number" : " numbers") + ", not " +
           std::to_string(values.size());
  double largest = 0.0;
  for (const double v : values) {
    if (info.kind == OptionKind::boolean && v != 0.0 && v != 1.0)
      return ": " + std::to_string(v) + " is neither 0 (off) nor 1 (on)";
    if (!std::isfinite(v) || v < info.lowest || v > info.highest)
      return ": " + std::to_string(v) + " is not between " + std::to_string(info.lowest) + " and " +
             std::to_string(info.highest);
    largest = std::max(largest, std::abs(v));
  }
  if (info.kind == OptionKind::choice && values[0] != std::floor(values[0]))
    return ": " + std::to_string(values[0]) + " is not a whole number";
  if (count == 3 && largest == 0.0) return " is a direction and cannot be zero";
  return "";
}

std::size_t bytes_of(OptionKind kind) {
  switch (kind) {
    case OptionKind::boolean:
      return sizeof(bool);
    case OptionKind::choice:
      return sizeof(std::int32_t);
    case OptionKind::direction:
      return 3 * sizeof(double);
    case OptionKind::number:
      break;
  }
  return sizeof(double);
}

std::size_t alignment_of(OptionKind kind) {
  return kind == OptionKind::boolean  ? alignof(bool)
         : kind == OptionKind::choice ? alignof(std::int32_t)
                                      : alignof(double);
}

}  // namespace

std::string option_label(const TechniqueInfo& technique, std::string_view option) {
  return technique.name + ": option '" + std::string(option) + "'";
}

std::string_view kind_name(OptionKind kind) {
  constexpr std::array<std::string_view, 4> kNames = {"boolean", "number", "direction", "choice"};
  return kNames[static_cast<std::size_t>(kind)];
}

TechniqueOptions::TechniqueOptions(const TechniqueInfo& technique)
    : technique_(technique.name), block_(technique.default_options) {}

const Block& TechniqueOptions::block(const TechniqueInfo& technique) const {
  if (block_.empty()) return technique.default_options;
  if (technique_ != technique.name || block_.size() != technique.default_options.size())
    throw Error(ErrorKind::invalid_input, "the options of " + technique_ + " were given to " +
                                              technique.name + "; give it options of its own");
  return block_;
}

Block& TechniqueOptions::edit(const TechniqueInfo& technique) {
  if (block_.empty()) *this = TechniqueOptions(technique);
  (void)block(technique);
  return block_;
}

OptionValue option_value(const TechniqueInfo& technique, const OptionInfo& option,
                         const TechniqueOptions& options) {
  return read_option(option, options.block(technique).data());
}

bool is_listed(const TechniqueInfo& technique, const OptionInfo& option,
               const TechniqueOptions& options) {
  return option.always_listed || option_value(technique, option, options) !=
                                     option_value(technique, option, TechniqueOptions());
}

void set_option(const TechniqueInfo& technique, TechniqueOptions& options, std::string_view name,
                std::span<const double> values) {
  const std::string label = option_label(technique, name);
  for (const OptionInfo& info : technique.options) {
    if (info.name != name) continue;
    const std::string wrong = fault(info, values);
    if (!wrong.empty()) throw Error(ErrorKind::invalid_input, label + wrong);
    return write(info, options.edit(technique), values);
  }
  const std::string names =
      comma_list(technique.options, [](const OptionInfo& info) { return info.name; });
  throw Error(
      ErrorKind::invalid_input,
      label + " does not exist; " + (names.empty() ? "it has none" : "its options are " + names));
}

namespace {

// All but its default.
void require_sound_row(const TechniqueInfo& technique, const OptionInfo& option) {
  const std::string label = option_label(technique, option.name);
  const std::size_t size = technique.default_options.size();
  const std::size_t bytes = bytes_of(option.kind);
  if (option.offset > size || size - option.offset < bytes)
    throw Error(ErrorKind::invalid_input, label + " lies outside the block of options, which has " +
                                              std::to_string(size) +
                                              " bytes; give the offset of its member");
  if (option.offset % alignment_of(option.kind) != 0)
    throw Error(ErrorKind::invalid_input, label + " stands at byte " +
                                              std::to_string(option.offset) +
                                              ", where no member of its kind can; give the offset "
                                              "of its member");
  if (option.kind == OptionKind::choice && option.choices.empty())
    throw Error(ErrorKind::invalid_input, label + " is a choice without names of its values");
  const auto twice = std::find_if(
      option.choices.begin(), option.choices.end(), [&option](const std::string& choice) {
        return std::count(option.choices.begin(), option.choices.end(), choice) > 1;
      });
  if (twice != option.choices.end())
    throw Error(ErrorKind::invalid_input, label + " has two choices '" + *twice + "'");
  if (std::isnan(option.lowest) || std::isnan(option.highest) || option.lowest > option.highest)
    throw Error(ErrorKind::invalid_input, label + ": its lowest value is above its highest");
}

void require_sound_default(const TechniqueInfo& technique, const OptionInfo& option,
                           std::span<const double> values) {
  const std::string wrong = fault(option, values);
  if (!wrong.empty())
    throw Error(ErrorKind::invalid_input,
                option_label(technique, option.name) + ", its default" + wrong);
}

}  // namespace

void require_sound_option(const TechniqueInfo& technique, const OptionInfo& option) {
  require_sound_row(technique, option);
  const OptionValue value = read_option(option, technique.default_options.data());
  require_sound_default(technique, option, {value.begin(), value.end()});
}

void set_default(TechniqueInfo& technique, const OptionInfo& option,
                 std::span<const double> values) {
  require_sound_row(technique, option);
  require_sound_default(technique, option, values);
  write(option, technique.default_options, values);
}

}  // namespace mimicry
