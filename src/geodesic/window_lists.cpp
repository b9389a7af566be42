#include "geodesic/window_lists.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace mimicry::geodesic {
namespace {

// Windows narrower than this part of their edge are dropped: their neighbours' distances, taken
// around the corner, differ from theirs by the square of it.
constexpr double kLeastWidth = 1e-11;
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
  const Window& newer;
  const Window& older;
  double offset;  // the newer source's own distance less the older's
  double least_width;
  double tie;

  double difference(double x) const { return offset + (newer.to_source(x) - older.to_source(x)); }
  int sign(double g) const { return g < -tie ? -1 : g > tie ? 1 : 0; }

  // The zero of the difference between a and b, where it has opposite signs: regula falsi with the
  // Illinois rule.
  double zero(double a, double ga, double b, double gb) const {
    int side = 0;
    for (int i = 0; i < 60 && b - a > least_width; ++i) {
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

  void split(double a, double b, Segments& out) const {
    const double ga = difference(a);
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
    // The difference turns once at most: where the line through both sources meets the edge.
    const double run = older.y - newer.y;
    const double at = newer.x * older.y - older.x * newer.y;
    if (run != 0.0 && (run > 0.0 ? at > a * run && at < b * run : at < a * run && at > b * run)) {
      const double x = std::clamp(at / run, a, b);
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
    blocks_.push_back({std::make_unique_for_overwrite<Window[]>(block_size), block_size});
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
  std::copy(left_.begin(), left_.end(), list.first);
  std::copy(right_.rbegin(), right_.rend(), list.first + left_.size());
}

WindowLists::Merged WindowLists::merge(Index edge, double edge_length, std::span<const Window> windows) {
  List& list = lists_[static_cast<std::size_t>(edge)];
  left_.clear();
  right_.assign(std::reverse_iterator(list.first + list.count), std::reverse_iterator(list.first));
  Merged merged;
  for (const Window& w : windows) insert(edge_length, w, merged);
  store(list);
  return merged;
}

void WindowLists::insert(double edge_length, const Window& window, Merged& merged) {
  const double least = kLeastWidth * edge_length;
  double open = window.begin;  // the new window owns what lies between here and the next older one
  const auto close = [&](double end) {
    if (end - open <= least) return;
    left_.push_back(window);
    left_.back().begin = open;
    left_.back().end = end;
    ++merged.pieces;
    merged.nearest = std::min(merged.nearest, sigma(window.root) + left_.back().nearest());
  };

  while (!right_.empty() && right_.back().end <= window.begin) {
    left_.push_back(right_.back());
    right_.pop_back();
  }
  while (!left_.empty() && left_.back().end > window.begin) {
    right_.push_back(left_.back());
    left_.pop_back();
  }
  while (!right_.empty() && right_.back().begin < window.end) {
    const Window older = right_.back();
    right_.pop_back();
    const double a = std::max(window.begin, older.begin);
    const double b = std::min(window.end, older.end);
    Segments segments;
    if (older.begin < a - least) segments.add(older.begin, a, false);
    if (b - a > least) {
      const double scale = std::max(distance(older, a), distance(window, a)) + edge_length;
      Comparison{window, older, sigma(window.root) - sigma(older.root), least, kTie * scale}.split(a, b,
                                                                                        segments);
    } else {
      segments.add(a, b, false);
    }
    if (older.end > b + least) segments.add(b, older.end, false);

    for (int k = 0; k < segments.count; ++k) {
      const Segment& s = segments.items[static_cast<std::size_t>(k)];
      if (s.newer || (s.end - s.begin <= least && segments.count > 1)) continue;
      close(s.begin);
      left_.push_back(older);
      left_.back().begin = s.begin;
      left_.back().end = s.end;
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

}  // namespace mimicry::geodesic
