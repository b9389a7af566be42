#include "lab/study_numbers.h"

#include <algorithm>
#include <array>
#include <span>

#include <mimicry/study/recording.h>

#include "io/number.h"

namespace mimicry::lab {
namespace {

constexpr std::array<std::string_view, 2> kMethods = {"spraycan", "mimicry"};
static_assert(kSpraycan == 0 && kMimicry == 1);

Index number_of(std::string_view name, std::span<const std::string_view> names) {
  const auto at = std::find(names.begin(), names.end(), name);
  return at == names.end() ? kNone : static_cast<Index>(at - names.begin());
}

std::string name_of(std::string_view cell, std::span<const std::string_view> names) {
  const auto number = parse_integer(cell);
  if (!number || *number < 0 || *number >= static_cast<long long>(names.size()))
    return std::string(cell);
  return std::string(names[static_cast<std::size_t>(*number)]);
}

}  // namespace

Index number_of_method(std::string_view name) {
  return number_of(name, kMethods);
}

Index number_of_shape(std::string_view name) {
  return number_of(name, kStudyShapes);
}

std::string_view shape_of_number(Index number) {
  const auto at = static_cast<std::size_t>(number);
  return number >= 0 && at < kStudyShapes.size() ? kStudyShapes[at] : std::string_view();
}

std::string name_of_method(std::string_view cell) {
  return name_of(cell, kMethods);
}

std::string name_of_shape(std::string_view cell) {
  return name_of(cell, kStudyShapes);
}

}  // namespace mimicry::lab
