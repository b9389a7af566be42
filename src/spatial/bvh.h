#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include <mimicry/base/types.h>

#include "base/large_vector.h"
#include "spatial/lanes.h"
#include "spatial/leaf_order.h"

namespace mimicry {

/// Lets everything through.
struct NoSieve {
  template <class... Any>
  explicit NoSieve(const Any&...) {}
  void set_bound(float) {}
};

/// Four primitives of which nothing is known: each must be tested.
template <class Primitive>
class PlainPack {
 public:
  using NearSieve = NoSieve;
  using RaySieve = NoSieve;

  void set(int lane, const Primitive& p) { primitives_[static_cast<std::size_t>(lane)] = p; }
  const Primitive& get(std::size_t lane) const { return primitives_[lane]; }
  unsigned candidates(const NearSieve&) const { return 15U; }

 private:
  std::array<Primitive, 4> primitives_;
};

/// A pack without the primitives, which are at hand elsewhere: visitors get the number, and this.
class NoPack {
 public:
  using NearSieve = NoSieve;
  using RaySieve = NoSieve;

  template <class Primitive>
  void set(int, const Primitive&) {}
  NoPack get(std::size_t) const { return {}; }
  unsigned candidates(const NearSieve&) const { return 15U; }
};

namespace detail {

template <class Primitive>
constexpr auto pack_of() {
  if constexpr (requires { typename Primitive::Pack; })
    return std::type_identity<typename Primitive::Pack>();
  else
    return std::type_identity<PlainPack<Primitive>>();
}

}  // namespace detail

/// Bounding-volume hierarchy over primitives in R^Dim: triangles of a surface, tetrahedra of a
/// shell, triangles in R^8. A primitive is any copyable type with
/// `Eigen::AlignedBox<double, Dim> box() const`; the hierarchy keeps the primitives itself, four to
/// a leaf, in its `Pack` if it names one (`TrianglePack`), which spares most of the vain visits.
/// Queries hand candidates to a visitor, which decides; every primitive that could matter is
/// visited, so that the answer never depends on the tree. `BruteForce` has the same interface.
///
/// Nodes have kWidth children and boxes in float, rounded outward, relative to the content's centre
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
  /// The same, without a search for where to divide: from primitives that stand in an order in
  /// which neighbours are near (`leaf_order`; any order gives equal answers). order: #count,
  /// leaves hold primitive(order[i]); as they come where it is empty. within: holds all their
  /// boxes. primitive is called once for each, in the order of the leaves. Much faster than a
  /// build; queries are some tens of percent slower than after one (docs/performance.md). O(count).
  template <class Get>
  Bvh(const Box& within, Index count, Get&& primitive, std::span<const Index> order = {});

  /// The same primitives moved: new boxes on the old tree. Slower queries than after a build where
  /// they moved far, equal answers. No allocation. O(count).
  template <class Get>
  void refit(Get&& primitive);

  Index size() const { return count_; }
  std::size_t memory_bytes() const {
    return nodes_.capacity() * sizeof(Node) + leaves_.capacity() * sizeof(Leaf);
  }

  /// Branch and bound, nearer boxes first. visit(i, primitive, bound2) returns the new squared
  /// bound, not larger than the one it got. Visited are, at least, all primitives with a point
  /// whose squared distance to y is at most the bound that stands at the end (of primitives without
  /// a pack of their own: all whose box has one). y: finite, below 1e60.
  template <class Visit>
  void nearest(const Point& y, double bound2, Visit&& visit) const;

  /// visit(i, primitive) for each primitive whose box contains y (and some near it) until it
  /// returns true. Whether it did.
  template <class Visit>
  bool containing(const Point& y, Visit&& visit) const;

  /// Primitives along the ray origin + t direction, 0 <= t <= bound, nearer boxes first.
  /// visit(i, primitive, bound) returns the new bound, not larger. direction: unit length. From
  /// more than 1e12 times the content's size away nothing is met: rounding alone would decide.
  template <class Visit>
  void along(const Point& origin, const Point& direction, double bound, Visit&& visit) const;

 private:
  static constexpr int kWidth = 4;
  static constexpr int kBlocks = kWidth / 4;  // of four lanes
  using Lanes = std::array<Float4, kBlocks>;
  // Children: a node's number, or ~(leaf << 3 | count - 1); the boxes of unused lanes are empty.
  struct alignas(64) Node {
    std::array<Lanes, 2 * Dim> planes;  // lower bounds of the children by axis, then upper
    std::array<std::int32_t, kWidth> children;
  };
  static constexpr int kMostInLeaf = 4;
  using Pack = typename decltype(detail::pack_of<Primitive>())::type;
  // Unused lanes repeat the first primitive. Leaves of numbers alone are packed densely.
  static constexpr std::size_t kLeafAlignment = std::is_empty_v<Pack> ? 16 : 64;
  struct alignas(kLeafAlignment) Leaf {
    [[no_unique_address]] Pack pack;
    std::array<Index, kMostInLeaf> numbers;
  };
  static constexpr std::int32_t kUnused = std::numeric_limits<std::int32_t>::min();
  // Beyond kHeuristicDepth levels ranges are halved, which ends within 31 more.
  static constexpr int kHeuristicDepth = 24;
  static constexpr int kStack = (kWidth - 1) * (kHeuristicDepth + 32) + 1;
  static constexpr float kFloatInfinity = std::numeric_limits<float>::infinity();
  // More than all rounding of a chain of Dim + 4 float operations.
  static constexpr double kSlack = 1.0 + (Dim + 8) * 1.2e-7;

  struct Builder;
  struct OrderedBuilder;

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

  const Leaf& leaf(std::int32_t child) const {
    return leaves_[~static_cast<std::uint32_t>(child) >> 3];
  }
  static unsigned used_lanes(std::int32_t child) {
    return (2U << (~static_cast<std::uint32_t>(child) & 7U)) - 1U;
  }
  // visit(i, primitive) for each lane of a set.
  template <class Visit>
  static void for_each_lane(const Leaf& leaf, unsigned lanes, Visit&& visit) {
    for (; lanes != 0; lanes &= lanes - 1) {
      const std::size_t lane = lowest_lane(lanes);
      visit(leaf.numbers[lane], leaf.pack.get(lane));
    }
  }

  static std::size_t lowest_lane(unsigned lanes) {
    return static_cast<std::size_t>(lowest_bit(lanes));
  }
  static double plane(const Node& node, int p, int lane) {
    return static_cast<double>(
        node.planes[static_cast<std::size_t>(p)][static_cast<std::size_t>(lane / 4)][lane % 4]);
  }

  Point inside(const Point& x) const { return (x - centre_) * scale_; }
  void set_frame(const Box& all);
  template <class Get>
  static void set_pack(Leaf& leaf, Get&& primitive) {
    for (int lane = 0; lane < kMostInLeaf; ++lane)
      leaf.pack.set(lane, primitive(leaf.numbers[static_cast<std::size_t>(lane)]));
  }
  void set_child_box(Node& node, int lane, const std::array<float, 2 * Dim>& box) const {
    for (std::size_t p = 0; p < 2 * Dim; ++p)
      node.planes[p][static_cast<std::size_t>(lane / 4)][lane % 4] = box[p];
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
  MIMICRY_INLINE static std::int32_t push_all_but_nearest(const Node& node, unsigned hit,
                                                          const Lanes& keys, Entry* stack,
                                                          int& top);

  template <class Visit>
  void nearest_from_afar(const Point& y, double bound2, Visit&& visit) const;

  LargeVector<Node> nodes_;  // children come after their parents
  LargeVector<Leaf> leaves_;
  Index count_ = 0;
  std::int32_t root_ = 0;
  Point centre_ = Point::Zero();
  double scale_ = 1.0;  // a power of two; content is within [-1, 1]^Dim
};

}  // namespace mimicry

#include "spatial/bvh_build.h"
#include "spatial/bvh_query.h"
