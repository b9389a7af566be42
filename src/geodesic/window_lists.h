#pragma once

#include <cmath>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <mimicry/base/types.h>

namespace mimicry {

/// Part of an edge from which straight lines run back to one source through the same faces
/// (Mitchell, Mount and Papadimitriou 1987). Coordinates are along the edge from its tail (x) and
/// away from it (y >= 0, on the side that the source lies on after unfolding).
struct Window {
  double begin;
  double end;
  double x;  ///< the source
  double y;
  Index root;    ///< number of the source's own distance, `WindowLists::sigma`
  bool forward;  ///< goes on over the edge's forward half-edge
  bool waits;    ///< has not been sent on yet

  double to_source(double at) const { return std::sqrt((at - x) * (at - x) + y * y); }
};
static_assert(sizeof(Window) == 40);

/// Windows on top of each other. Fields are written and read one by one: a window read as a whole
/// right after its fields were written would wait for them.
class WindowStack {
 public:
  bool empty() const { return count_ == 0; }
  std::size_t size() const { return count_; }
  Window& top() { return windows_[count_ - 1]; }
  void pop() { --count_; }
  void clear() { count_ = 0; }
  void push(const Window& w) { push(w, w.begin, w.end); }
  /// Part of a window.
  void push(const Window& w, double begin, double end) {
    if (count_ == windows_.size()) windows_.resize(2 * count_ + 16);
    Window& top = windows_[count_++];
    top.begin = begin;
    top.end = end;
    top.x = w.x;
    top.y = w.y;
    top.root = w.root;
    top.forward = w.forward;
    top.waits = w.waits;
  }
  std::span<Window> windows() { return {windows_.data(), count_}; }
  std::size_t memory_bytes() const { return windows_.capacity() * sizeof(Window); }

 private:
  std::vector<Window> windows_;
  std::size_t count_ = 0;
};

/// The windows of all edges, on each edge side by side without overlap: where two would overlap
/// each keeps the part where it is nearer.
class WindowLists {
 public:
  void reset(std::size_t edge_count);

  /// Registers a distance that windows start from.
  Index add_root(double sigma) {
    sigmas_.push_back(sigma);
    return static_cast<Index>(sigmas_.size()) - 1;
  }
  double sigma(Index root) const { return sigmas_[static_cast<std::size_t>(root)]; }
  double distance(const Window& w, double at) const { return sigma(w.root) + w.to_source(at); }

  struct Merged {
    std::size_t pieces = 0;      ///< of the new windows that stay
    double nearest = kInfinity;  ///< the least distance on them
  };
  /// Puts windows on an edge, best in ascending order. What they cover elsewhere stays with whoever
  /// is nearer; ties stay as they are.
  Merged merge(Index edge, double edge_length, std::span<const Window> windows);

  std::span<const Window> operator[](Index edge) const {
    const List& list = lists_[static_cast<std::size_t>(edge)];
    return {list.first, list.count};
  }
  std::span<Window> operator[](Index edge) {
    const List& list = lists_[static_cast<std::size_t>(edge)];
    return {list.first, list.count};
  }

  std::size_t memory_bytes() const;

 private:
  struct List {
    Window* first = nullptr;
    std::uint32_t count = 0;
    std::uint32_t size_class = 0;  // of the place it has, 0: none
  };
  struct Block {
    std::unique_ptr<Window[]> windows;
    std::size_t size = 0;
  };

  void insert(double edge_length, const Window& window, Merged& merged);
  void store(List& list);
  Window* take(std::size_t size_class);

  std::vector<List> lists_;  // #E
  std::vector<double> sigmas_;
  std::vector<Block> blocks_;  // places of all lists; growing moves nothing
  std::size_t block_ = 0;      // being filled, up to
  std::size_t used_ = 0;
  std::vector<std::vector<Window*>> free_;  // places given back, by size class
  // The list being merged, cut in two where the next window goes in: to the left in order, to the
  // right backwards.
  WindowStack left_;
  WindowStack right_;
};

}  // namespace mimicry
