#pragma once

// Traversals of `Bvh`; included by bvh.h.

namespace mimicry {

template <int Dim, class PrimitiveType>
inline std::int32_t Bvh<Dim, PrimitiveType>::push_all_but_nearest(const Node& node, unsigned hit,
                                                                  const Lanes& keys, Entry* stack,
                                                                  int& top) {
  const auto key = [&](int lane) { return keys[static_cast<std::size_t>(lane / 4)][lane % 4]; };
  const int first = lowest_bit(hit);
  hit &= hit - 1;
  std::int32_t nearest = node.children[static_cast<std::size_t>(first)];
  if (hit == 0) return nearest;
  float nearest_key = key(first);
  const int base = top;
  do {
    const int lane = lowest_bit(hit);
    hit &= hit - 1;
    Entry entry = {key(lane), node.children[static_cast<std::size_t>(lane)]};
    if (entry.key < nearest_key) {
      std::swap(entry.key, nearest_key);
      std::swap(entry.child, nearest);
    }
    // A few: the farthest lies deepest.
    int at = top++;
    while (at > base && stack[at - 1].key < entry.key) {
      stack[at] = stack[at - 1];
      --at;
    }
    stack[at] = entry;
  } while (hit != 0);
  return nearest;
}

template <int Dim, class PrimitiveType>
template <class Visit>
void Bvh<Dim, PrimitiveType>::nearest(const Point& y, double bound2, Visit&& visit) const {
  if (count_ == 0) return;
  const Point local = inside(y);
  // From afar a float cannot tell the boxes apart.
  if (!(local.cwiseAbs().maxCoeff() < 256.0)) return nearest_from_afar(y, bound2, visit);
  std::array<Float4, Dim> low, high;
  for (int k = 0; k < Dim; ++k) {
    low[static_cast<std::size_t>(k)] = splat(down(local[k] - kBoxPad * 256.0));
    high[static_cast<std::size_t>(k)] = splat(up(local[k] + kBoxPad * 256.0));
  }
  const double scale2 = scale_ * scale_;
  float bound = bound_up(bound2 * scale2);
  typename Pack::NearSieve sieve(y, scale_);
  sieve.set_bound(bound);

  std::array<Entry, kStack> stack;
  int top = 0;
  std::int32_t child = root_;
  while (true) {
    while (child >= 0) {
      const Node& node = nodes_[static_cast<std::size_t>(child)];
      Lanes distance2;
      unsigned hit = 0;
      for (std::size_t j = 0; j < kBlocks; ++j) {
        distance2[j] = splat(0.0F);
        for (std::size_t k = 0; k < Dim; ++k) {
          const Float4 d =
              max(max(node.planes[k][j] - high[k], low[k] - node.planes[k + Dim][j]), splat(0.0F));
          distance2[j] += d * d;
        }
        hit |= bits(distance2[j] <= splat(bound)) << (4 * j);
      }
      if (hit == 0) goto next;
      child = push_all_but_nearest(node, hit, distance2, stack.data(), top);
    }
    {
      const Leaf& l = leaf(child);
      const auto consider = [&](Index i, const auto& primitive) {
        const double smaller = visit(i, primitive, bound2);
        if (!(smaller < bound2)) return;
        bound2 = smaller;
        bound = bound_up(bound2 * scale2);
        sieve.set_bound(bound);
      };
      unsigned lanes = used_lanes(child);
      // Without a bound there is nothing to sieve by: the first one gives it.
      if (bound2 == kInfinity) {
        consider(l.numbers[0], l.pack.get(0));
        lanes &= ~1U;
      }
      for_each_lane(l, lanes & l.pack.candidates(sieve), consider);
    }
  next:
    do {
      if (top == 0) return;
      --top;
    } while (stack[static_cast<std::size_t>(top)].key > bound);
    child = stack[static_cast<std::size_t>(top)].child;
  }
}

template <int Dim, class PrimitiveType>
template <class Visit>
void Bvh<Dim, PrimitiveType>::nearest_from_afar(const Point& y, double bound2,
                                                Visit&& visit) const {
  struct FarEntry {
    double key;
    std::int32_t child;
  };
  const Point local = inside(y);
  const double scale2 = scale_ * scale_;
  const auto limit = [&](double b) { return b * scale2 * (1.0 + 1e-12); };
  // Of one coordinate's rounding, and of the boxes'.
  const double pad = 1e-15 * local.cwiseAbs().maxCoeff();

  std::array<FarEntry, kStack> stack;
  std::size_t top = 0;
  stack[top++] = {0.0, root_};
  while (top > 0) {
    const FarEntry entry = stack[--top];
    if (entry.key > limit(bound2)) continue;
    if (entry.child < 0) {
      for_each_lane(leaf(entry.child), used_lanes(entry.child),
                    [&](Index i, const auto& primitive) {
                      bound2 = std::min(bound2, visit(i, primitive, bound2));
                    });
      continue;
    }
    const Node& node = nodes_[static_cast<std::size_t>(entry.child)];
    const std::size_t base = top;
    for (int lane = 0; lane < kWidth; ++lane) {
      const std::int32_t child = node.children[static_cast<std::size_t>(lane)];
      if (child == kUnused) continue;
      double key = 0.0;
      for (int k = 0; k < Dim; ++k) {
        const double low = plane(node, k, lane), high = plane(node, k + Dim, lane);
        const double d = std::max({low - local[k] - pad, local[k] - high - pad, 0.0});
        key += d * d;
      }
      if (key > limit(bound2)) continue;
      std::size_t at = top++;
      for (; at > base && stack[at - 1].key < key; --at) stack[at] = stack[at - 1];
      stack[at] = {key, child};
    }
  }
}

template <int Dim, class PrimitiveType>
template <class Visit>
bool Bvh<Dim, PrimitiveType>::containing(const Point& y, Visit&& visit) const {
  if (count_ == 0) return false;
  const Point local = inside(y);
  if (!(local.cwiseAbs().maxCoeff() <= 1.0)) return false;
  std::array<Float4, Dim> low, high;
  for (int k = 0; k < Dim; ++k) {
    low[static_cast<std::size_t>(k)] = splat(down(local[k]));
    high[static_cast<std::size_t>(k)] = splat(up(local[k]));
  }
  std::array<std::int32_t, kStack> stack;
  std::size_t top = 0;
  stack[top++] = root_;
  while (top > 0) {
    const std::int32_t child = stack[--top];
    if (child < 0) {
      const Leaf& l = leaf(child);
      for (unsigned lanes = used_lanes(child); lanes != 0; lanes &= lanes - 1)
        if (visit(l.numbers[lowest_lane(lanes)], l.pack.get(lowest_lane(lanes)))) return true;
      continue;
    }
    const Node& node = nodes_[static_cast<std::size_t>(child)];
    for (std::size_t j = 0; j < kBlocks; ++j) {
      Mask4 in = Mask4{-1, -1, -1, -1};
      for (std::size_t k = 0; k < Dim; ++k)
        in &= (node.planes[k][j] <= high[k]) & (low[k] <= node.planes[k + Dim][j]);
      for (unsigned hit = bits(in); hit != 0; hit &= hit - 1)
        stack[top++] = node.children[4 * j + lowest_lane(hit)];
    }
  }
  return false;
}

template <int Dim, class PrimitiveType>
template <class Visit>
void Bvh<Dim, PrimitiveType>::along(const Point& origin, const Point& direction, double bound,
                                    Visit&& visit) const {
  if (count_ == 0) return;
  Point local = inside(origin);
  const double size = local.cwiseAbs().maxCoeff();
  if (!(size <= 1e12)) return;
  // Covers the rounding of the primitive's own test, relative to its distance from the origin.
  const double pad = 8e-15 * (1.0 + size);
  Point inverse_direction;
  for (int k = 0; k < Dim; ++k)
    inverse_direction[k] =
        1.0 / std::copysign(std::max(std::abs(direction[k]), 1e-18), direction[k]);
  // From outside, the boxes are met from where the ray enters the content's cube, so that floats
  // serve from any distance.
  double enter = 0.0;
  if (size > 1.0) {
    double leave = kInfinity;
    for (int k = 0; k < Dim; ++k) {
      const double side = std::copysign(1.0 + pad, direction[k]);
      enter = std::max(enter, (-side - local[k]) * inverse_direction[k]);
      leave = std::min(leave, (side - local[k]) * inverse_direction[k]);
    }
    if (enter * (1.0 - 1e-14) > leave * (1.0 + 1e-14)) return;
    local += enter * direction;
    // A ray that nearly misses from nearly infinitely far: rounding alone decides, and it misses.
    if (!(local.cwiseAbs().maxCoeff() <= 4.0 + pad)) return;
  }

  // Near planes are met a little sooner and far ones a little later than computed.
  constexpr double kShrink = 1.0 - 6e-7, kGrow = 1.0 + 6e-7;
  std::array<Float4, Dim> near_origin, away_origin, near_inverse, away_inverse;
  std::array<std::size_t, Dim> near_plane, away_plane;
  for (int k = 0; k < Dim; ++k) {
    const auto i = static_cast<std::size_t>(k);
    const bool is_up = !std::signbit(direction[k]);
    const float low = down(local[k] - pad), high = up(local[k] + pad);
    near_plane[i] = is_up ? i : i + Dim;
    away_plane[i] = is_up ? i + Dim : i;
    near_origin[i] = splat(is_up ? high : low);
    away_origin[i] = splat(is_up ? low : high);
    near_inverse[i] = splat(static_cast<float>(inverse_direction[k] * kShrink));
    away_inverse[i] = splat(static_cast<float>(inverse_direction[k] * kGrow));
  }
  const auto limit = [&](double b) { return bound_up(std::max(b * scale_ - enter, 0.0) + pad); };
  float float_bound = limit(bound);
  typename Pack::RaySieve sieve(origin, direction, inverse_direction, scale_, 1.0 + size, pad);
  sieve.set_bound(bound_up(bound * scale_ + pad));

  std::array<Entry, kStack> stack;
  int top = 0;
  std::int32_t child = root_;
  while (true) {
    while (child >= 0) {
      const Node& node = nodes_[static_cast<std::size_t>(child)];
      Lanes near;
      unsigned hit = 0;
      for (std::size_t j = 0; j < kBlocks; ++j) {
        near[j] = splat(0.0F);
        Float4 away = splat(float_bound);
        for (std::size_t k = 0; k < Dim; ++k) {
          near[j] =
              max(near[j], (node.planes[near_plane[k]][j] - near_origin[k]) * near_inverse[k]);
          away = min(away, (node.planes[away_plane[k]][j] - away_origin[k]) * away_inverse[k]);
        }
        hit |= bits(near[j] <= away) << (4 * j);
      }
      if (hit == 0) goto next;
      child = push_all_but_nearest(node, hit, near, stack.data(), top);
    }
    {
      const Leaf& l = leaf(child);
      for_each_lane(l, l.pack.candidates(sieve) & used_lanes(child),
                    [&](Index i, const auto& primitive) {
                      const double smaller = visit(i, primitive, bound);
                      if (!(smaller < bound)) return;
                      bound = smaller;
                      float_bound = limit(bound);
                      sieve.set_bound(bound_up(bound * scale_ + pad));
                    });
    }
  next:
    do {
      if (top == 0) return;
      --top;
    } while (stack[static_cast<std::size_t>(top)].key > float_bound);
    child = stack[static_cast<std::size_t>(top)].child;
  }
}

}  // namespace mimicry
