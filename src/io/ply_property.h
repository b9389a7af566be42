#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace mimicry {

/// The types of a PLY's numbers.
enum class PlyType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

inline std::size_t ply_size_of(PlyType type) {
  switch (type) {
    case PlyType::int8:
    case PlyType::uint8:
      return 1;
    case PlyType::int16:
    case PlyType::uint16:
      return 2;
    case PlyType::int32:
    case PlyType::uint32:
    case PlyType::float32:
      return 4;
    case PlyType::float64:
      break;
  }
  return 8;
}

inline bool is_whole_ply_type(PlyType type) {
  return type != PlyType::float32 && type != PlyType::float64;
}

inline std::optional<PlyType> ply_type_of(std::string_view word) {
  if (word == "char" || word == "int8") return PlyType::int8;
  if (word == "uchar" || word == "uint8") return PlyType::uint8;
  if (word == "short" || word == "int16") return PlyType::int16;
  if (word == "ushort" || word == "uint16") return PlyType::uint16;
  if (word == "int" || word == "int32") return PlyType::int32;
  if (word == "uint" || word == "uint32") return PlyType::uint32;
  if (word == "float" || word == "float32") return PlyType::float32;
  if (word == "double" || word == "float64") return PlyType::float64;
  return std::nullopt;
}

struct PlyProperty {
  std::string_view name;
  std::optional<PlyType> count_type;  // lists only
  PlyType type;
};

/// The count of a list, which the file can hold.
template <class Source>
std::int64_t ply_list_size(Source& source, const PlyProperty& property) {
  const std::int64_t count = source.integer(*property.count_type);
  if (count < 0 || static_cast<std::uint64_t>(count) * source.least_size(property.type) >
                       source.bytes_left() + Source::kSlack)
    source.fail("a list of " + std::to_string(count) +
                " items, more than the file holds; it is cut short or not what its header says");
  return count;
}

// What is passed over need not be numbers.
template <class Source>
void skip_ply_property(Source& source, const PlyProperty& property) {
  const std::int64_t count = property.count_type ? ply_list_size(source, property) : 1;
  for (std::int64_t k = 0; k < count; ++k) source.skip(property.type);
}

}  // namespace mimicry
