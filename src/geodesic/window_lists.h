#pragma once

#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

#include <mimicry/base/types.h>

namespace mimicry::geodesic {

/// Part of an edge from which straight lines run back to one source through the same faces
/// (Mitchell, Mount and Papadimitriou 1987). Coordinates are along the edge from its tail (x) and
/// away from it (y >= 0, on the side that the source lies on after unfolding).
struct Window {
  enum State : Index { dead = -1, waiting, done };  // two bits

  double begin = 0.0;
  double end = 0.0;
  double x = 0.0;  ///< the source
  double y = 0.0;
  double sigma = 0.0;      ///< distance of the source itself
  Index next = kNone;      ///< the window to the right on the same edge
  Index entered : 30 = 0;  ///< the edge's half-edge on the side away from the source
  Index state : 2 = waiting;

  double distance(double at) const { return sigma + std::sqrt((at - x) * (at - x) + y * y); }
  /// The least distance on the window.
  double nearest() const {
    return x < begin ? distance(begin) : x > end ? distance(end) : sigma + y;
  }
};

/// The windows of all edges, on each edge side by side without overlap: where two would overlap
/// each keeps the part where it is nearer.
class WindowLists {
 public:
  void reset(std::size_t edge_count);

  /// Puts `window` on an edge and appends to `added` the numbers of all windows that now wait and
  /// did not before. What it covers elsewhere stays with whoever is nearer; ties stay as they are.
  void insert(Index edge, double edge_length, const Window& window, std::vector<Index>& added);

  Index first(Index edge) const { return first_[static_cast<std::size_t>(edge)]; }
  const Window& operator[](Index i) const {
    return blocks_[static_cast<std::size_t>(i) / kBlock][static_cast<std::size_t>(i) % kBlock];
  }
  Window& operator[](Index i) {
    return blocks_[static_cast<std::size_t>(i) / kBlock][static_cast<std::size_t>(i) % kBlock];
  }
  /// To be called for a dead window when nothing refers to it any more.
  void release(Index i);

  std::size_t memory_bytes() const {
    return blocks_.size() * kBlock * sizeof(Window) + first_.capacity() * sizeof(Index);
  }

 private:
  Index append_after(Index edge, Index previous, const Window& window);

  // In blocks, so that growing neither copies nor holds memory twice.
  static constexpr std::size_t kBlock = 4096;
  std::vector<std::unique_ptr<Window[]>> blocks_;
  std::size_t used_ = 0;
  std::vector<Index> first_;  // #E
  Index free_ = kNone;
};

}  // namespace mimicry::geodesic
