#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <tuple>
#include <utility>
#include <vector>

#include <mimicry/base/types.h>
#include <mimicry/spatial/lanes.h>

namespace mimicry::spatial {

/// Bounding-volume hierarchy over primitives in R^Dim: triangles of a surface, tetrahedra of a
/// shell, triangles in R^8. A primitive is any copyable type with
/// `Eigen::AlignedBox<double, Dim> box() const`; the hierarchy keeps the primitives itself, in the
/// order of its leaves. Queries hand candidates to a visitor, which decides; every primitive that
/// could matter is visited, so that the answer never depends on the tree. `BruteForce` has the same
/// interface.
///
/// Nodes have four children and boxes in float, rounded outward, relative to the content's centre
/// and size: a scaled or shifted content has the same relative accuracy. Built top-down with the
/// surface-area heuristic in 16 bins (Wald 2007); the same primitives give the same tree.
template <int Dim, class PrimitiveType>
class Bvh {
 public:
  using Primitive = PrimitiveType;
  using Point = Eigen::Matrix<double, Dim, 1>;
  using Box = Eigen::AlignedBox<double, Dim>;

  Bvh() = default;
  /// primitive(i) gives primitive i of `count`; finite, sizes between 1e-30 and 1e30. Within those
  /// every number here stays in range. O(count log count).
  template <class Get>
  Bvh(Index count, Get&& primitive);

  /// The same primitives moved: new boxes on the old tree. Slower queries than after a build where
  /// they moved far, equal answers. No allocation. O(count).
  template <class Get>
  void refit(Get&& primitive);

  Index size() const { return static_cast<Index>(slots_.size()); }
  std::size_t memory_bytes() const {
    return nodes_.capacity() * sizeof(Node) + slots_.capacity() * sizeof(Slot);
  }

  /// Branch and bound, nearer boxes first. visit(i, primitive, bound2) returns the new squared
  /// bound, not larger than the one it got. Visited are, at least, all primitives whose box has a
  /// squared distance to y of at most the bound that stands at the end. y: finite, below 1e60.
  template <class Visit>
  void nearest(const Point& y, double bound2, Visit&& visit) const;

  /// visit(i, primitive) for each primitive whose box contains y (and perhaps some whose box only
  /// nearly does) until it returns true. Whether it did.
  template <class Visit>
  bool containing(const Point& y, Visit&& visit) const;

  /// Primitives along the ray origin + t direction, 0 <= t <= bound, nearer boxes first.
  /// visit(i, primitive, bound) returns the new bound, not larger. direction: unit length.
  template <class Visit>
  void along(const Point& origin, const Point& direction, double bound, Visit&& visit) const;

 private:
  // Children: a node's number, or ~(first slot << 3 | count - 1) for a leaf; the boxes of unused
  // lanes are empty.
  struct alignas(64) Node {
    std::array<Float4, 2 * Dim> planes;  // lower bounds of the four children by axis, then upper
    std::array<std::int32_t, 4> children;
  };
  struct Slot {
    Primitive primitive;
    Index number;
  };
  static constexpr int kWidth = 4;
  static constexpr int kMostInLeaf = 4;
  static constexpr std::int32_t kUnused = std::numeric_limits<std::int32_t>::min();
  // Beyond kHeuristicDepth levels ranges are halved, which ends within 31 more.
  static constexpr int kHeuristicDepth = 24;
  static constexpr int kStack = (kWidth - 1) * (kHeuristicDepth + 32) + 1;
  static constexpr float kFloatInfinity = std::numeric_limits<float>::infinity();
  // More than all rounding of a chain of Dim + 4 float operations.
  static constexpr double kSlack = 1.0 + (Dim + 8) * 1.2e-7;

  struct Builder;

  struct Entry {
    float key;
    std::int32_t child;
  };

  // Floats on either side of x, two steps away at most; without a branch.
  static float down(double x) {
    const float f = static_cast<float>(x);
    return f - (std::abs(f) * 1.2e-7F + 1e-30F);
  }
  static float up(double x) {
    const float f = static_cast<float>(x);
    return f + (std::abs(f) * 1.2e-7F + 1e-30F);
  }
  // A bound as a float that is not smaller, nor infinite: the boxes of unused lanes are.
  static float bound_up(double x) {
    return x < 1e37 ? static_cast<float>(x * kSlack) + std::numeric_limits<float>::min()
                    : std::numeric_limits<float>::max();
  }

  template <class Function>
  static void for_each_slot(std::int32_t leaf, Function&& function) {
    const std::uint32_t code = ~static_cast<std::uint32_t>(leaf);
    const std::size_t first = code >> 3, last = first + (code & 7U);
    for (std::size_t slot = first; slot <= last; ++slot) function(slot);
  }

  Point inside(const Point& x) const { return (x - centre_) * scale_; }
  void set_frame(const Box& all);
  void set_child_box(Node& node, int lane, const std::array<float, 2 * Dim>& box) const {
    for (std::size_t p = 0; p < 2 * Dim; ++p) node.planes[p][lane] = box[p];
  }
  std::array<float, 2 * Dim> float_box(const Box& box) const {
    std::array<float, 2 * Dim> result;
    for (int k = 0; k < Dim; ++k) {
      result[static_cast<std::size_t>(k)] = down((box.min()[k] - centre_[k]) * scale_ - kBoxPad);
      result[static_cast<std::size_t>(k + Dim)] =
          up((box.max()[k] - centre_[k]) * scale_ + kBoxPad);
    }
    return result;
  }
  // Rounding of the change of coordinates, whose results are at most 1.
  static constexpr double kBoxPad = 4e-16;

  // Pushes the lanes of `hit` and returns the one with the smallest key.
  static std::int32_t push_all_but_nearest(const Node& node, unsigned hit, Float4 key, Entry* stack,
                                           int& top);

  template <class Visit>
  void nearest_from_afar(const Point& y, double bound2, Visit&& visit) const;

  std::vector<Node> nodes_;  // children come after their parents
  std::vector<Slot> slots_;  // by leaf
  std::int32_t root_ = 0;
  Point centre_ = Point::Zero();
  double scale_ = 1.0;  // a power of two; content is within [-1, 1]^Dim
};

}  // namespace mimicry::spatial

#include <mimicry/spatial/bvh_build.h>
#include <mimicry/spatial/bvh_query.h>
