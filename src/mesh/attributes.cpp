#include <cmath>
#include <string>
#include <utility>

#include <mimicry/base/error.h>
#include <mimicry/mesh/attributes.h>

namespace mimicry {
namespace {

[[noreturn]] void fail(const std::string& what) {
  throw Error(ErrorKind::invalid_input, "mesh attributes: " + what);
}

void require_numbers(const std::vector<Index>& numbers, std::size_t wanted, std::size_t known,
                     const std::string& what) {
  if (numbers.empty()) return;
  if (numbers.size() != wanted)
    fail(std::to_string(numbers.size()) + " numbers of " + what + " where " +
         std::to_string(wanted) + " are needed");
  for (const Index n : numbers)
    if (n != kNone && (n < 0 || static_cast<std::size_t>(n) >= known))
      fail("there is no " + what + " " + std::to_string(n) + " among " + std::to_string(known));
}

std::size_t heap_bytes(const FaceLabels& labels) {
  std::size_t bytes = labels.of_face.capacity() * sizeof(Index);
  for (const std::string& name : labels.names) bytes += sizeof(name) + name.capacity();
  return bytes;
}

template <std::size_t N>
std::size_t heap_bytes(const CornerValues<N>& values) {
  return values.values.capacity() * sizeof(typename CornerValues<N>::Value) +
         values.corners.capacity() * sizeof(Index);
}

void turn(std::vector<Index>& corners, const std::vector<bool>& turned) {
  if (corners.empty()) return;
  for (std::size_t f = 0; f < turned.size(); ++f)
    if (turned[f]) std::swap(corners[3 * f + 1], corners[3 * f + 2]);
}

}  // namespace

std::size_t MeshAttributes::memory_bytes() const {
  return heap_bytes(texcoords) + heap_bytes(colors) + heap_bytes(groups) + heap_bytes(materials) +
         heap_bytes(objects);
}

void MeshAttributes::require_fit(Index faces) const {
  const std::size_t count = at(faces);
  require_numbers(texcoords.corners, 3 * count, texcoords.values.size(), "texture coordinates");
  require_numbers(colors.corners, 3 * count, colors.values.size(), "colour");
  require_numbers(groups.of_face, count, groups.names.size(), "group");
  require_numbers(materials.of_face, count, materials.names.size(), "material");
  require_numbers(objects.of_face, count, objects.names.size(), "object");
}

void MeshAttributes::turn_faces(const std::vector<bool>& turned) {
  turn(texcoords.corners, turned);
  turn(colors.corners, turned);
}

double linear_from_srgb(double encoded) {
  const double x = std::abs(encoded);
  const double linear = x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4);
  return std::copysign(linear, encoded);
}

double srgb_from_linear(double linear) {
  const double x = std::abs(linear);
  const double encoded = x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1.0 / 2.4) - 0.055;
  return std::copysign(encoded, linear);
}

}  // namespace mimicry
