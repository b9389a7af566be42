#pragma once

// Building and refitting of `Bvh`; included by bvh.h.

namespace mimicry {

template <int Dim, class PrimitiveType>
struct Bvh<Dim, PrimitiveType>::Builder {
  static constexpr int kParts = (Dim + 3) / 4;
  static constexpr int kBins = 16;

  struct Bounds {
    std::array<Float4, kParts> low, high;

    static Bounds empty() {
      Bounds b;
      b.low.fill(splat(kFloatInfinity));
      b.high.fill(splat(-kFloatInfinity));
      return b;
    }
    void extend(const Bounds& other) {
      for (std::size_t i = 0; i < kParts; ++i) {
        low[i] = min(low[i], other.low[i]);
        high[i] = max(high[i], other.high[i]);
      }
    }
    float lower(int k) const { return low[static_cast<std::size_t>(k / 4)][k % 4]; }
    float upper(int k) const { return high[static_cast<std::size_t>(k / 4)][k % 4]; }
    // Half the surface in R^3; in general the sum over pairs of axes, which stays meaningful for
    // the flat sheets that surfaces in R^8 are.
    float area() const {
      float sum = 0.0F, result = 0.0F;
      for (int k = 0; k < Dim; ++k) {
        const float extent = upper(k) - lower(k);
        result += extent * sum;
        sum += extent;
      }
      return result;
    }
  };
  struct Range {
    Index first, last;
    Bounds bounds;
    Index count() const { return last - first; }
  };

  Bvh& bvh;
  std::vector<Bounds> boxes;
  std::vector<Index> order;

  Bounds bounds_of(Index first, Index last) const {
    Bounds b = Bounds::empty();
    for (Index i = first; i < last; ++i) b.extend(boxes[static_cast<std::size_t>(i)]);
    return b;
  }

  // Twice the centre, so that no rounding is needed to speak of.
  static float centre(const Bounds& b, int k) { return b.lower(k) + b.upper(k); }

  /// Splits a range in two, neither empty.
  std::pair<Range, Range> split(const Range& range, bool halve) {
    Index middle = range.first;
    if (!halve) middle = split_by_area(range);
    if (middle == range.first || middle == range.last) middle = split_in_half(range);
    return {{range.first, middle, bounds_of(range.first, middle)},
            {middle, range.last, bounds_of(middle, range.last)}};
  }

  Index split_by_area(const Range& range) {
    Bounds centres = Bounds::empty();
    for (Index i = range.first; i < range.last; ++i) {
      const Bounds& b = boxes[static_cast<std::size_t>(i)];
      Bounds c;
      for (std::size_t j = 0; j < kParts; ++j) c.low[j] = c.high[j] = b.low[j] + b.high[j];
      centres.extend(c);
    }
    std::array<Float4, kParts> origin, per_bin;
    for (std::size_t j = 0; j < kParts; ++j) {
      origin[j] = centres.low[j];
      const Float4 extent = centres.high[j] - centres.low[j];
      for (int l = 0; l < 4; ++l)
        per_bin[j][l] = extent[l] > 1e-30F ? 0.9999F * kBins / extent[l] : 0.0F;
    }
    const auto bin_of = [&](const Bounds& b, int k) {
      const auto j = static_cast<std::size_t>(k / 4);
      const float x = (centre(b, k) - origin[j][k % 4]) * per_bin[j][k % 4];
      return std::min(static_cast<int>(x), kBins - 1);
    };

    struct Bin {
      Bounds bounds;
      Index count;
    };
    std::array<std::array<Bin, kBins>, Dim> bins;
    for (auto& axis : bins) axis.fill({Bounds::empty(), 0});
    for (Index i = range.first; i < range.last; ++i) {
      const Bounds& b = boxes[static_cast<std::size_t>(i)];
      for (int k = 0; k < Dim; ++k) {
        Bin& bin = bins[static_cast<std::size_t>(k)][static_cast<std::size_t>(bin_of(b, k))];
        bin.bounds.extend(b);
        ++bin.count;
      }
    }

    float best = kFloatInfinity;
    int best_axis = -1, best_bin = 0;
    for (int k = 0; k < Dim; ++k) {
      if (per_bin[static_cast<std::size_t>(k / 4)][k % 4] == 0.0F) continue;
      const auto& axis = bins[static_cast<std::size_t>(k)];
      std::array<float, kBins> right_cost;
      Bounds sweep = Bounds::empty();
      Index count = 0;
      for (std::size_t i = kBins - 1; i > 0; --i) {
        sweep.extend(axis[i].bounds);
        count += axis[i].count;
        right_cost[i] = count > 0 ? sweep.area() * static_cast<float>(count) : kFloatInfinity;
      }
      sweep = Bounds::empty();
      count = 0;
      for (std::size_t i = 1; i < kBins; ++i) {
        sweep.extend(axis[i - 1].bounds);
        count += axis[i - 1].count;
        if (count == 0) continue;
        const float cost = sweep.area() * static_cast<float>(count) + right_cost[i];
        if (cost < best) {
          best = cost;
          best_axis = k;
          best_bin = static_cast<int>(i);
        }
      }
    }
    if (best_axis < 0) return range.first;

    Index i = range.first, j = range.last;
    while (i < j) {
      if (bin_of(boxes[static_cast<std::size_t>(i)], best_axis) < best_bin) {
        ++i;
      } else {
        --j;
        std::swap(boxes[static_cast<std::size_t>(i)], boxes[static_cast<std::size_t>(j)]);
        std::swap(order[static_cast<std::size_t>(i)], order[static_cast<std::size_t>(j)]);
      }
    }
    return i;
  }

  // By number: a choice that depends on nothing else.
  Index split_in_half(const Range& range) const { return range.first + range.count() / 2; }

  std::int32_t build(const Range& range, int depth) {
    if (range.count() <= kMostInLeaf) {
      const auto number = static_cast<std::int32_t>(bvh.leaves_.size());
      Leaf& leaf = bvh.leaves_.emplace_back();
      for (Index lane = 0; lane < kMostInLeaf; ++lane)
        leaf.numbers[static_cast<std::size_t>(lane)] = order[static_cast<std::size_t>(
            lane < range.count() ? range.first + lane : range.first)];
      return ~((number << 3) | (range.count() - 1));
    }
    const auto number = static_cast<std::int32_t>(bvh.nodes_.size());
    bvh.nodes_.emplace_back();

    std::array<Range, kWidth> ranges;
    ranges[0] = range;
    std::size_t used = 1;
    while (used < kWidth) {
      // The child with the largest surface is opened.
      std::size_t widest = kWidth;
      float area = -1.0F;
      for (std::size_t i = 0; i < used; ++i)
        if (ranges[i].count() > kMostInLeaf && ranges[i].bounds.area() > area) {
          area = ranges[i].bounds.area();
          widest = i;
        }
      if (widest == kWidth) break;
      std::tie(ranges[widest], ranges[used]) = split(ranges[widest], depth >= kHeuristicDepth);
      ++used;
    }
    std::array<std::int32_t, kWidth> children;
    children.fill(kUnused);
    for (std::size_t i = 0; i < used; ++i) children[i] = build(ranges[i], depth + 1);

    Node& node = bvh.nodes_[static_cast<std::size_t>(number)];
    node.children = children;
    for (int lane = 0; lane < kWidth; ++lane) {
      const bool is_used = static_cast<std::size_t>(lane) < used;
      const Bounds& b = ranges[static_cast<std::size_t>(lane)].bounds;
      std::array<float, 2 * Dim> box;
      for (int k = 0; k < Dim; ++k) {
        box[static_cast<std::size_t>(k)] = is_used ? b.lower(k) : kFloatInfinity;
        box[static_cast<std::size_t>(k + Dim)] = is_used ? b.upper(k) : -kFloatInfinity;
      }
      bvh.set_child_box(node, lane, box);
    }
    return number;
  }
};

template <int Dim, class PrimitiveType>
struct Bvh<Dim, PrimitiveType>::OrderedBuilder {
  static_assert(LeafBlocks::kInLeaf == kMostInLeaf && LeafBlocks::kWidth == kWidth);
  using FloatBox = std::array<float, 2 * Dim>;

  Bvh& bvh;
  std::span<const Index> order;

  static FloatBox empty() {
    FloatBox box;
    for (std::size_t k = 0; k < Dim; ++k) {
      box[k] = kFloatInfinity;
      box[k + Dim] = -kFloatInfinity;
    }
    return box;
  }

  // box: of them all.
  template <class Get>
  std::int32_t build(Index first, Index last, Get& primitive, FloatBox& box) {
    if (last - first <= kMostInLeaf) {
      const auto number = static_cast<std::int32_t>(bvh.leaves_.size());
      Leaf& leaf = bvh.leaves_.emplace_back();
      Box bounds;
      for (Index lane = 0; lane < kMostInLeaf; ++lane) {
        const Index place = first + lane < last ? first + lane : first;
        const Index i = order.empty() ? place : order[static_cast<std::size_t>(place)];
        leaf.numbers[static_cast<std::size_t>(lane)] = i;
        const auto p = primitive(i);
        leaf.pack.set(lane, p);
        bounds.extend(p.box());
      }
      box = bvh.float_box(bounds);
      return ~((number << 3) | (last - first - 1));
    }
    const auto number = static_cast<std::int32_t>(bvh.nodes_.size());
    bvh.nodes_.emplace_back();
    const Index size = LeafBlocks::child_size(last - first);
    box = empty();
    for (int lane = 0; lane < kWidth; ++lane) {
      FloatBox part = empty();
      std::int32_t child = kUnused;
      const Index begin = first + lane * size;
      if (begin < last) {
        child = build(begin, std::min(begin + size, last), primitive, part);
        for (std::size_t k = 0; k < Dim; ++k) {
          box[k] = std::min(box[k], part[k]);
          box[k + Dim] = std::max(box[k + Dim], part[k + Dim]);
        }
      }
      Node& node = bvh.nodes_[static_cast<std::size_t>(number)];
      node.children[static_cast<std::size_t>(lane)] = child;
      bvh.set_child_box(node, lane, part);
    }
    return number;
  }
};

template <int Dim, class PrimitiveType>
template <class Get>
Bvh<Dim, PrimitiveType>::Bvh(const Box& within, Index count, Get&& primitive,
                             std::span<const Index> order) {
  if (count == 0) return;
  assert(count < (1 << 28));
  assert(order.empty() || order.size() == static_cast<std::size_t>(count));
  set_frame(within);
  nodes_.reserve(static_cast<std::size_t>(count) / 12 + 32);
  leaves_.reserve((static_cast<std::size_t>(count) + kMostInLeaf - 1) / kMostInLeaf);
  typename OrderedBuilder::FloatBox box;
  root_ = OrderedBuilder{*this, order}.build(0, count, primitive, box);
  count_ = count;
}

template <int Dim, class PrimitiveType>
void Bvh<Dim, PrimitiveType>::set_frame(const Box& all) {
  centre_ = all.min() + 0.5 * (all.max() - all.min());
  const double half = 0.5 * (all.max() - all.min()).maxCoeff();
  // half * scale is in [0.25, 0.5]: with room for rounding.
  scale_ = half > 1e-60 ? std::ldexp(1.0, -std::ilogb(half) - 2) : 1.0;
}

template <int Dim, class PrimitiveType>
template <class Get>
Bvh<Dim, PrimitiveType>::Bvh(Index count, Get&& primitive) {
  if (count == 0) return;
  assert(count < (1 << 28));
  Box all;
  for (Index i = 0; i < count; ++i) all.extend(primitive(i).box());
  set_frame(all);

  Builder builder{*this, {}, {}};
  builder.order.resize(static_cast<std::size_t>(count));
  builder.boxes.resize(static_cast<std::size_t>(count));
  for (Index i = 0; i < count; ++i) {
    builder.order[static_cast<std::size_t>(i)] = i;
    const std::array<float, 2 * Dim> box = float_box(primitive(i).box());
    auto& bounds = builder.boxes[static_cast<std::size_t>(i)];
    bounds.low.fill(splat(0.0F));
    bounds.high.fill(splat(0.0F));
    for (std::size_t k = 0; k < Dim; ++k) {
      bounds.low[k / 4][k % 4] = box[k];
      bounds.high[k / 4][k % 4] = box[k + Dim];
    }
  }
  nodes_.reserve(static_cast<std::size_t>(count) / 4 + 1);
  leaves_.reserve(static_cast<std::size_t>(count) / 2 + 1);
  root_ = builder.build({0, count, builder.bounds_of(0, count)}, 0);
  nodes_.shrink_to_fit();
  leaves_.shrink_to_fit();
  count_ = count;
  for (Leaf& leaf : leaves_) set_pack(leaf, primitive);
}

template <int Dim, class PrimitiveType>
template <class Get>
void Bvh<Dim, PrimitiveType>::refit(Get&& primitive) {
  if (count_ == 0) return;
  Box all;
  for (Index i = 0; i < count_; ++i) all.extend(primitive(i).box());
  set_frame(all);
  // A hierarchy of one leaf has no node.
  for (Leaf& leaf : leaves_) set_pack(leaf, primitive);
  for (std::size_t n = nodes_.size(); n-- > 0;) {
    Node& node = nodes_[n];
    for (int lane = 0; lane < kWidth; ++lane) {
      const std::int32_t child = node.children[static_cast<std::size_t>(lane)];
      std::array<float, 2 * Dim> box;
      if (child >= 0) {
        const Node& below = nodes_[static_cast<std::size_t>(child)];
        for (std::size_t k = 0; k < Dim; ++k) {
          Float4 low = below.planes[k][0], high = below.planes[k + Dim][0];
          for (std::size_t j = 1; j < kBlocks; ++j) {
            low = min(low, below.planes[k][j]);
            high = max(high, below.planes[k + Dim][j]);
          }
          box[k] = std::min(std::min(low[0], low[1]), std::min(low[2], low[3]));
          box[k + Dim] = std::max(std::max(high[0], high[1]), std::max(high[2], high[3]));
        }
      } else if (child != kUnused) {
        const Leaf& changed = leaves_[~static_cast<std::uint32_t>(child) >> 3];
        Box bounds;
        for (const Index i : changed.numbers) bounds.extend(primitive(i).box());
        box = float_box(bounds);
      } else {
        continue;
      }
      set_child_box(node, lane, box);
    }
  }
}

}  // namespace mimicry
