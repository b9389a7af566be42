#include "io/attribute_writing.h"

#include <cmath>

#include "io/attribute_builder.h"
#include "io/text.h"

namespace mimicry {

template <std::size_t N>
std::optional<std::vector<Index>> values_of_vertices(const TriangleMesh& mesh,
                                                     const CornerValues<N>& values) {
  constexpr Index kUnseen = kNone - 1;
  std::vector<Index> of_vertex(at(mesh.vertex_count()), kUnseen);
  for (Index f = 0; f < mesh.face_count(); ++f)
    for (std::size_t k = 0; k < 3; ++k) {
      const Index value = values.corners[3 * at(f) + k];
      Index& known = of_vertex[at(mesh.face(f)[k])];
      if (known == kUnseen)
        known = value;
      else if (known != value && (known == kNone || value == kNone ||
                                  values.values[at(known)] != values.values[at(value)]))
        return std::nullopt;
    }
  for (Index& value : of_vertex)
    if (value == kUnseen) value = kNone;
  return of_vertex;
}

template std::optional<std::vector<Index>> values_of_vertices(const TriangleMesh&,
                                                              const CornerValues<2>&);
template std::optional<std::vector<Index>> values_of_vertices(const TriangleMesh&,
                                                              const CornerValues<4>&);

std::array<double, 4> encoded_color(const std::array<float, 4>& linear) {
  return {srgb_from_linear(static_cast<double>(linear[0])),
          srgb_from_linear(static_cast<double>(linear[1])),
          srgb_from_linear(static_cast<double>(linear[2])), static_cast<double>(linear[3])};
}

std::optional<std::array<unsigned char, 4>> color_bytes(const std::array<float, 4>& linear) {
  const std::array<double, 4> encoded = encoded_color(linear);
  std::array<unsigned char, 4> bytes;
  std::array<double, 4> back;
  for (std::size_t k = 0; k < 4; ++k) {
    const double byte = std::round(255.0 * encoded[k]);
    if (!(byte >= 0.0 && byte <= 255.0)) return std::nullopt;
    bytes[k] = static_cast<unsigned char>(byte);
    back[k] = byte / 255.0;
  }
  if (color_from_srgb(back[0], back[1], back[2], back[3]) != linear) return std::nullopt;
  return bytes;
}

std::optional<std::vector<std::array<unsigned char, 4>>> color_bytes(
    const std::vector<std::array<float, 4>>& linear) {
  std::vector<std::array<unsigned char, 4>> all;
  for (const auto& color : linear) {
    const auto bytes = color_bytes(color);
    if (!bytes) return std::nullopt;
    all.push_back(*bytes);
  }
  return all;
}

std::string label_text(const std::string& name) {
  std::string line = one_line(name);
  std::string_view trimmed = line;
  while (!trimmed.empty() && is_blank(trimmed.front())) trimmed.remove_prefix(1);
  while (!trimmed.empty() && is_blank(trimmed.back())) trimmed.remove_suffix(1);
  return std::string(trimmed);
}

}  // namespace mimicry
