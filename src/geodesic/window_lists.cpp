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
  double least_width;
  double tie;

  double difference(double x) const { return newer.distance(x) - older.distance(x); }
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

}  // namespace

void WindowLists::reset(std::size_t edge_count) {
  used_ = 0;
  free_ = kNone;
  first_.assign(edge_count, kNone);
}

void WindowLists::release(Index i) {
  (*this)[i].next = free_;
  free_ = i;
}

Index WindowLists::append_after(Index edge, Index previous, const Window& window) {
  Index i = free_;
  if (i != kNone) {
    free_ = (*this)[i].next;
    (*this)[i] = window;
  } else {
    if (used_ == blocks_.size() * kBlock) blocks_.push_back(std::make_unique<Window[]>(kBlock));
    i = static_cast<Index>(used_++);
    (*this)[i] = window;
  }
  Index& link = previous == kNone ? first_[static_cast<std::size_t>(edge)] : (*this)[previous].next;
  (*this)[i].next = link;
  link = i;
  return i;
}

void WindowLists::insert(Index edge, double edge_length, const Window& window,
                         std::vector<Index>& added) {
  const double least = kLeastWidth * edge_length;
  double open = window.begin;  // the new window owns what lies between here and the next older one
  Index previous = kNone;
  const auto close = [&](double end) {
    if (end - open <= least) return;
    Window piece = window;
    piece.begin = open;
    piece.end = end;
    previous = append_after(edge, previous, piece);
    added.push_back(previous);
  };

  Index i = first(edge);
  while (i != kNone && (*this)[i].end <= window.begin) previous = i, i = (*this)[i].next;
  while (i != kNone && (*this)[i].begin < window.end) {
    const Window older = (*this)[i];
    const double a = std::max(window.begin, older.begin);
    const double b = std::min(window.end, older.end);
    Segments segments;
    if (older.begin < a - least) segments.add(older.begin, a, false);
    if (b - a > least) {
      const double scale = std::max(older.distance(a), window.distance(a)) + edge_length;
      Comparison{window, older, least, kTie * scale}.split(a, b, segments);
    } else {
      segments.add(a, b, false);
    }
    if (older.end > b + least) segments.add(b, older.end, false);

    bool kept = false;
    for (int k = 0; k < segments.count; ++k) {
      const Segment& s = segments.items[static_cast<std::size_t>(k)];
      if (s.newer || (s.end - s.begin <= least && segments.count > 1)) continue;
      close(s.begin);
      if (!kept) {
        (*this)[i].begin = s.begin;
        (*this)[i].end = s.end;
        previous = i;
      } else {
        Window copy = older;
        copy.begin = s.begin;
        copy.end = s.end;
        previous = append_after(edge, previous, copy);
        if (copy.state == Window::waiting) added.push_back(previous);
      }
      kept = true;
      open = std::max(open, s.end);
    }
    const Index next = kept ? (*this)[previous].next : (*this)[i].next;
    if (!kept) {
      (previous == kNone ? first_[static_cast<std::size_t>(edge)] : (*this)[previous].next) = next;
      if (older.state == Window::waiting)
        (*this)[i].state = Window::dead;  // the queue still holds it
      else
        release(i);
    }
    i = next;
  }
  close(window.end);
}

}  // namespace mimicry::geodesic
