#include "geodesic/window_lists.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include "geodesic/tolerances.h"

namespace mimicry {
namespace {

// Distances closer than this, relative to themselves and the edge, are equal: some roundings.
constexpr double kTie = 1e-12;

struct Segment {
  double begin;
  double end;
  bool newer;
};

struct Segments {
  std::array<Segment, 5> items;
  int count = 0;
  void add(double begin, double end, bool newer) {
    if (count > 0 && items[static_cast<std::size_t>(count - 1)].newer == newer)
      items[static_cast<std::size_t>(count - 1)].end = end;
    else
      items[static_cast<std::size_t>(count++)] = {begin, end, newer};
  }
};

// Where on an edge the newer window is nearer than the older.
struct Comparison {
  Comparison(const Window& newer_in, double newer_sigma, const Window& older_in, double older_sigma,
             double edge_length)
      : newer(newer_in),
        older(older_in),
        offset(newer_sigma - older_sigma),
        farther_sigma(std::max(newer_sigma, older_sigma)),
        length(edge_length) {}

  const Window& newer;
  const Window& older;
  double offset;
  double farther_sigma;
  double length;
  double tie = 0.0;

  double difference(double x) const { return offset + (newer.to_source(x) - older.to_source(x)); }
  int sign(double g) const { return g < -tie ? -1 : g > tie ? 1 : 0; }

  // The zero of the difference between a and b, where it has opposite signs: regula falsi with the
  // Illinois rule.
  double zero(double a, double ga, double b, double gb) const {
    int side = 0;
    for (int i = 0; i < 60 && b - a > kLeastWidth * length; ++i) {
      const double x = std::clamp((a * gb - b * ga) / (gb - ga), a, b);
      const double g = difference(x);
      if (std::abs(g) <= tie) return x;
      if ((g < 0.0) == (gb < 0.0)) {
        b = x, gb = g;
        if (side == 1) ga *= 0.5;
        side = 1;
      } else {
        a = x, ga = g;
        if (side == -1) gb *= 0.5;
        side = -1;
      }
    }
    return 0.5 * (a + b);
  }

  // The difference at a.
  double begin_at(double a) {
    const double newer_a = newer.to_source(a);
    const double older_a = older.to_source(a);
    tie = kTie * (farther_sigma + std::max(newer_a, older_a) + length);
    return offset + (newer_a - older_a);
  }

  // Where the older window keeps what lies between a and the result, and the newer has the rest up
  // to b: the common case. Negative in any other.
  double cut(double a, double b) {
    const double ga = begin_at(a);
    if (ga < -tie) return -1.0;
    const double gb = difference(b);
    if (gb < -tie) return ga > tie ? zero(a, ga, b, gb) : -1.0;
    return turns(a, b) ? -1.0 : b;
  }

  // Whether the difference has an extremum between a and b, which lies where the line through both
  // sources meets the edge.
  bool turns(double a, double b) const {
    const double run = older.y - newer.y;
    const double at = newer.x * older.y - older.x * newer.y;
    return (at > a * run) != (at > b * run);
  }

  void split(double a, double b, Segments& out) {
    const double ga = begin_at(a);
    const double gb = difference(b);
    const int sa = sign(ga);
    const int sb = sign(gb);
    if (sa * sb < 0) {
      const double x = zero(a, ga, b, gb);
      out.add(a, x, sa < 0);
      out.add(x, b, sb < 0);
      return;
    }
    const int both = sa + sb;
    if (turns(a, b)) {
      const double x =
          std::clamp((newer.x * older.y - older.x * newer.y) / (older.y - newer.y), a, b);
      const double gx = difference(x);
      const int sx = sign(gx);
      if (sx * both < 0) {
        const double x0 = sa == 0 ? a : zero(a, ga, x, gx);
        const double x1 = sb == 0 ? b : zero(x, gx, b, gb);
        out.add(a, x0, both < 0);
        out.add(x0, x1, sx < 0);
        out.add(x1, b, both < 0);
        return;
      }
      if (both == 0) {
        out.add(a, b, sx < 0);
        return;
      }
    }
    out.add(a, b, both < 0);
  }
};

// Places for lists come in sizes of 1 to 8 windows, and four between each two powers of 2 above.
std::size_t size_class_of(std::size_t count) {
  if (count <= 8) return count;
  std::size_t unit = 2;
  std::size_t base = 8;
  while (count > 8 * unit) unit *= 2, base += 4;
  return base + (count + unit - 1) / unit - 4;
}

std::size_t class_size(std::size_t size_class) {
  if (size_class <= 8) return size_class;
  const std::size_t octave = (size_class - 9) / 4;
  return ((size_class - 9) % 4 + 5) << (octave + 1);
}

constexpr std::size_t kBlock = 8192;

}  // namespace

void WindowLists::reset(std::size_t edge_count) {
  lists_.assign(edge_count, {});
  sigmas_.clear();
  block_ = 0;
  used_ = 0;
  for (auto& places : free_) places.clear();
}

Window* WindowLists::take(std::size_t size_class) {
  if (size_class >= free_.size()) free_.resize(size_class + 1);
  if (!free_[size_class].empty()) {
    Window* place = free_[size_class].back();
    free_[size_class].pop_back();
    return place;
  }
  const std::size_t size = class_size(size_class);
  while (block_ < blocks_.size() && used_ + size > blocks_[block_].size) ++block_, used_ = 0;
  if (block_ == blocks_.size()) {
    const std::size_t block_size = std::max(kBlock, size);
    // std::make_unique_for_overwrite, which libc++ 13 lacks.
    blocks_.push_back({std::unique_ptr<Window[]>(new Window[block_size]), block_size});
  }
  Window* place = &blocks_[block_].windows[used_];
  used_ += size;
  return place;
}

// Puts what is on the two stacks back.
void WindowLists::store(List& list) {
  const std::size_t count = left_.size() + right_.size();
  const std::size_t size_class = size_class_of(count);
  if (size_class != list.size_class) {
    if (list.size_class != 0) free_[list.size_class].push_back(list.first);
    list.first = count > 0 ? take(size_class) : nullptr;
    list.size_class = static_cast<std::uint32_t>(size_class);
  }
  list.count = static_cast<std::uint32_t>(count);
  std::copy(left_.windows().begin(), left_.windows().end(), list.first);
  std::copy(right_.windows().rbegin(), right_.windows().rend(), list.first + left_.size());
}

WindowLists::Merged WindowLists::merge(Index edge, double edge_length,
                                       std::span<const Window> windows) {
  List& list = lists_[static_cast<std::size_t>(edge)];
  left_.clear();
  right_.clear();
  for (std::size_t i = list.count; i-- > 0;) right_.push(list.first[i]);
  Merged merged;
  for (const Window& w : windows) insert(edge_length, w, merged);
  store(list);
  return merged;
}

void WindowLists::insert(double edge_length, const Window& window, Merged& merged) {
  const double least = kLeastWidth * edge_length;
  const double window_sigma = sigma(window.root);
  double open = window.begin;  // the new window owns what lies between here and the next older one
  const auto close = [&](double end) {
    if (end - open <= least) return;
    left_.push(window, open, end);
    ++merged.pieces;
    // Its nearest point, squared until it counts.
    const double nearer = merged.nearest - window_sigma;
    const double off = std::max({window.x - end, open - window.x, 0.0});
    const double squared = off * off + window.y * window.y;
    if (nearer > 0.0 && squared < nearer * nearer)
      merged.nearest = window_sigma + std::sqrt(squared);
  };

  while (!right_.empty() && right_.top().end <= window.begin) {
    left_.push(right_.top());
    right_.pop();
  }
  while (!left_.empty() && left_.top().begin > window.begin) {
    right_.push(left_.top());
    left_.pop();
  }
  bool is_left = !left_.empty() && left_.top().end > window.begin;
  // Mostly it only meets the end of the one before it.
  if (is_left && left_.top().end <= window.end && left_.top().end - window.begin > least) {
    Window& older = left_.top();
    const double cut = Comparison(window, window_sigma, older, sigma(older.root), edge_length)
                           .cut(window.begin, older.end);
    if (cut >= 0.0 && cut - older.begin > least) {
      older.end = cut;
      open = cut;
      is_left = false;
    }
  }
  while (is_left || (!right_.empty() && right_.top().begin < window.end)) {
    WindowStack& from = is_left ? left_ : right_;
    is_left = false;
    const Window& top = from.top();
    from.pop();
    const Window older{top.begin, top.end, top.x, top.y, top.root, top.forward, top.waits};
    const double a = std::max(window.begin, older.begin);
    const double b = std::min(window.end, older.end);
    Segments segments;
    if (older.begin < a - least) segments.add(older.begin, a, false);
    if (b - a > least) {
      Comparison(window, window_sigma, older, sigma(older.root), edge_length).split(a, b, segments);
    } else {
      segments.add(a, b, false);
    }
    if (older.end > b + least) segments.add(b, older.end, false);

    for (int k = 0; k < segments.count; ++k) {
      const Segment& s = segments.items[static_cast<std::size_t>(k)];
      if (s.newer || (s.end - s.begin <= least && segments.count > 1)) continue;
      close(s.begin);
      left_.push(older, s.begin, s.end);
      open = std::max(open, s.end);
    }
  }
  close(window.end);
}

std::size_t WindowLists::memory_bytes() const {
  std::size_t bytes = lists_.capacity() * sizeof(List) + sigmas_.capacity() * sizeof(double);
  for (const Block& b : blocks_) bytes += b.size * sizeof(Window);
  for (const auto& places : free_) bytes += places.capacity() * sizeof(Window*);
  return bytes;
}

}  // namespace mimicry
