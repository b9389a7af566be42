#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include <mimicry/base/types.h>

namespace mimicry {

/// N numbers at each corner of a mesh's faces. Corners name their values by number, as OBJ does:
/// corners with the same number share a value, and where the corners that meet at a vertex name
/// different ones there is a seam. Seams are no part of the geometry: they split no vertex.
template <std::size_t N>
struct CornerValues {
  using Value = std::array<float, N>;
  std::vector<Value> values;
  /// 3 #F: the number of the value at corner k of face f stands at 3 f + k; kNone: it has none.
  /// Empty: no corner has one.
  std::vector<Index> corners;

  bool empty() const { return corners.empty(); }
  /// The value at a corner of a face; null where it has none.
  const Value* at_corner(Index face, int k) const {
    if (corners.empty()) return nullptr;
    const Index value = corners[3 * at(face) + at(k)];
    return value == kNone ? nullptr : &values[at(value)];
  }
  /// The value at a point of a face, linear between its corners; NaN where one of them has none.
  Value interpolated(Index face, const Vec3& bary) const {
    std::array<double, N> sum = {};
    for (int k = 0; k < 3; ++k) {
      const Value* value = at_corner(face, k);
      for (std::size_t i = 0; i < N; ++i)
        sum[i] += value ? bary[k] * static_cast<double>((*value)[i])
                        : std::numeric_limits<double>::quiet_NaN();
    }
    Value result;
    for (std::size_t i = 0; i < N; ++i) result[i] = static_cast<float>(sum[i]);
    return result;
  }
  bool operator==(const CornerValues&) const = default;
};

/// A name for each face: of its group, material or object.
struct FaceLabels {
  std::vector<std::string> names;
  /// #F: the number of the face's name; kNone: it has none. Empty: no face has one.
  std::vector<Index> of_face;

  bool empty() const { return of_face.empty(); }
  bool operator==(const FaceLabels&) const = default;
};

/// What a mesh carries beside its geometry: each part may be empty. Geometry, bakes and their
/// cache do not look at it.
struct MeshAttributes {
  CornerValues<2> texcoords;  ///< u to the right, v up: (0, 0) is the image's lower left corner
  CornerValues<4> colors;     ///< linear red, green, blue (of sRGB's primaries) and alpha
  FaceLabels groups, materials, objects;

  bool empty() const {
    return texcoords.empty() && colors.empty() && groups.empty() && materials.empty() &&
           objects.empty();
  }
  /// Heap memory held.
  std::size_t memory_bytes() const;
  /// Throws Error(invalid_input) where it does not fit a mesh of so many faces: lengths that are
  /// not 3 #F and #F (or 0), or numbers of values and names that there are not. O(#F).
  void require_fit(Index faces) const;
  /// Exchanges corners 1 and 2 of the faces for which `turned` (#F) is true. O(#F).
  void turn_faces(const std::vector<bool>& turned);

  bool operator==(const MeshAttributes&) const = default;
};

/// A component of a colour, from sRGB's encoding to linear light and back. Beyond 0 to 1 both go
/// on, below 0 as mirrored.
double linear_from_srgb(double encoded);
double srgb_from_linear(double linear);

}  // namespace mimicry
