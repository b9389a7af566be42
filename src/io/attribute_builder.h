#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <mimicry/mesh/attributes.h>
#include <mimicry/mesh/triangle_mesh.h>

namespace mimicry {

/// Collects the values of one kind: of vertices, or of faces' corners by number, not of both.
template <std::size_t N>
class CornerValueBuilder {
 public:
  using Value = typename CornerValues<N>::Value;

  /// A value that corners name by number, from 0 on.
  Index add(const Value& value) {
    values_.push_back(value);
    return static_cast<Index>(values_.size() - 1);
  }
  /// The same for a corner at a vertex; the vertex's last one where that is equal.
  Index add_at(Index vertex, const Value& value) {
    if (last_.size() <= at(vertex)) last_.resize(at(vertex) + 1, kNone);
    Index& last = last_[at(vertex)];
    if (last == kNone || values_[at(last)] != value) last = add(value);
    return last;
  }
  Index count() const { return static_cast<Index>(values_.size()); }
  /// Values of corners that name none of their own; a component that is not finite: none.
  void set_of_vertex(Index vertex, const Value& value) {
    if (values_.size() <= at(vertex)) values_.resize(at(vertex) + 1, none());
    values_[at(vertex)] = value;
    by_vertex_ = true;
  }
  /// face: higher than any before. numbers: not yet checked against the values.
  void set_face(std::size_t face, const Face& numbers) {
    if (corners_.size() < face) corners_.resize(face, Face{kNone, kNone, kNone});
    corners_.push_back(numbers);
  }
  /// Puts the corners of a polygon of faces [first, end), which are the fan (0, k, k + 1), to other
  /// faces of it: triples of its corners' numbers.
  void cut(std::size_t first, std::size_t end, std::span<const Face> triangles);
  void clear() { *this = {}; }

  /// The builder is empty afterwards. faces: of the mesh.
  CornerValues<N> finish(std::span<const Face> faces);

 private:
  static Value none();
  static bool is_none(const Value& value);

  std::vector<Value> values_;
  std::vector<Index> last_;    // of a vertex, by `add_at`
  std::vector<Face> corners_;  // of the first faces, the others have none
  bool by_vertex_ = false;     // corners have the values of their vertices
};

extern template class CornerValueBuilder<2>;
extern template class CornerValueBuilder<4>;

/// Collects names of faces, for runs of faces with the same one.
class FaceLabelBuilder {
 public:
  /// The number of a name, a new one where it is not known.
  Index number(std::string_view name);
  /// Faces from this one on have that name; kNone: none.
  void begin(std::size_t face, Index number);
  void clear() { *this = {}; }

  /// The builder is empty afterwards.
  FaceLabels finish(std::size_t faces);

 private:
  std::vector<std::string> names_;
  std::map<std::string, Index, std::less<>> known_;
  std::vector<std::pair<std::size_t, Index>> runs_;
};

/// The attributes that a reader finds, beside the faces of `MeshBuilder`.
struct AttributeBuilder {
  CornerValueBuilder<2> texcoords;
  CornerValueBuilder<4> colors;
  FaceLabelBuilder groups, materials, objects;

  void cut(std::size_t first, std::size_t end, std::span<const Face> triangles) {
    texcoords.cut(first, end, triangles);
    colors.cut(first, end, triangles);
  }
  void clear() { *this = {}; }
  /// Null where there are none. The builder is empty afterwards.
  std::shared_ptr<const MeshAttributes> finish(std::span<const Face> faces);
};

/// A colour as most files have it, encoded as in sRGB; alpha is not encoded.
inline std::array<float, 4> color_from_srgb(double r, double g, double b, double a = 1.0) {
  return {static_cast<float>(linear_from_srgb(r)), static_cast<float>(linear_from_srgb(g)),
          static_cast<float>(linear_from_srgb(b)), static_cast<float>(a)};
}

}  // namespace mimicry
