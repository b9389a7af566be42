#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include <mimicry/base/types.h>

namespace mimicry {

/// How a hierarchy divides primitives that stand in leaf order: in blocks of four leaves of four,
/// four such blocks, and so on, all full but the last.
struct LeafBlocks {
  static constexpr Index kInLeaf = 4, kWidth = 4;

  /// Of the children of a node of `count` primitives, more than a leaf holds; the last child has
  /// the rest.
  static Index child_size(Index count) {
    Index size = kInLeaf;
    while (size < (count + kWidth - 1) / kWidth) size *= kWidth;
    return size;
  }
};

/// The numbers of the points in an order in which every block of `LeafBlocks` lies together in
/// space: what is to be searched by a hierarchy over blocks (`Bvh`) stands in this order. Ranges
/// are cut at right angles to their longest side, again and again; ties go by number. The last
/// `last` points stay behind the others. Any finite coordinates. O(n log n).
template <int Dim>
std::vector<Index> leaf_order(std::span<const Eigen::Matrix<double, Dim, 1>> points,
                              Index last = 0) {
  using Point = Eigen::Matrix<double, Dim, 1>;
  struct Item {
    std::array<float, Dim> at;
    Index number;
  };
  class Sorter {
   public:
    explicit Sorter(std::vector<Item>& items) : items_(items) {}

    // All in [first, end) before `later` come before the others.
    void sort(Index first, Index end, Index later) {
      const Index count = end - first;
      if (count <= LeafBlocks::kInLeaf) return;
      const Index size = LeafBlocks::child_size(count);
      // In two halves of whole children, then those.
      if (count > 2 * size) {
        cut(first, first + 2 * size, end, later);
        cut(first, first + size, first + 2 * size, later);
        if (count > 3 * size) cut(first + 2 * size, first + 3 * size, end, later);
      } else {
        cut(first, first + size, end, later);
      }
      for (Index i = first; i < end; i += size) sort(i, std::min(i + size, end), later);
    }

   private:
    // The least by some coordinate come before `middle`.
    void cut(Index first, Index middle, Index end, Index later) {
      if (first < later && later < end) {
        if (middle == later) return;
        if (middle < later) end = later;
        if (middle > later) first = later;
      }
      std::array<float, Dim> low, high;
      low.fill(std::numeric_limits<float>::infinity());
      high.fill(-std::numeric_limits<float>::infinity());
      for (Index i = first; i < end; ++i)
        for (std::size_t k = 0; k < Dim; ++k) {
          const float x = items_[static_cast<std::size_t>(i)].at[k];
          low[k] = std::min(low[k], x);
          high[k] = std::max(high[k], x);
        }
      std::size_t axis = 0;
      for (std::size_t k = 1; k < Dim; ++k)
        if (high[k] - low[k] > high[axis] - low[axis]) axis = k;
      std::nth_element(items_.begin() + first, items_.begin() + middle, items_.begin() + end,
                       [axis](const Item& a, const Item& b) {
                         return a.at[axis] != b.at[axis] ? a.at[axis] < b.at[axis]
                                                         : a.number < b.number;
                       });
    }

    std::vector<Item>& items_;
  };

  const auto count = static_cast<Index>(points.size());
  assert(last >= 0 && last <= count);
  Eigen::AlignedBox<double, Dim> box;
  for (const Point& p : points) box.extend(p);
  const double size = count > 0 ? (0.5 * box.max() - 0.5 * box.min()).maxCoeff() : 0.0;
  const double scale = size > 1e-300 ? 1.0 / size : 0.0;
  std::vector<Item> items(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    items[i].number = static_cast<Index>(i);
    const Point local = (points[i] - box.min()) * scale;
    for (std::size_t k = 0; k < Dim; ++k)
      items[i].at[k] = static_cast<float>(local[static_cast<Eigen::Index>(k)]);
  }
  Sorter(items).sort(0, count, count - last);
  // What is left to chance within a leaf goes by number.
  std::vector<Index> order(points.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = items[i].number;
  for (Index first = 0; first < count; first += LeafBlocks::kInLeaf)
    std::sort(order.begin() + first, order.begin() + std::min(first + LeafBlocks::kInLeaf, count));
  return order;
}

}  // namespace mimicry
