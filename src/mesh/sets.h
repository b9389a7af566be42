#pragma once

#include <numeric>
#include <utility>
#include <vector>

#include <mimicry/base/types.h>

namespace mimicry {

/// Union-find with the parity of each element against its root; the root is the lowest number.
class Sets {
 public:
  explicit Sets(Index count) : parents_(at(count)), odd_(at(count), false) {
    std::iota(parents_.begin(), parents_.end(), Index{0});
  }
  struct Root {
    Index root;
    bool odd;
  };
  Root find(Index i) {
    Index root = i;
    bool odd = false;
    while (parents_[at(root)] != root) {
      odd ^= odd_[at(root)];
      root = parents_[at(root)];
    }
    bool rest = odd;
    while (parents_[at(i)] != root && i != root) {
      const Index next = parents_[at(i)];
      const bool step = odd_[at(i)];
      parents_[at(i)] = root;
      odd_[at(i)] = rest;
      rest ^= step;
      i = next;
    }
    return {root, odd};
  }
  Index root(Index i) { return find(i).root; }
  /// False where the two are already together with another parity.
  bool join(Index a, Index b, bool odd = false) {
    Root x = find(a), y = find(b);
    if (x.root == y.root) return (x.odd ^ y.odd) == odd;
    if (y.root < x.root) std::swap(x, y);
    parents_[at(y.root)] = x.root;
    odd_[at(y.root)] = x.odd ^ y.odd ^ odd;
    return true;
  }

 private:
  std::vector<Index> parents_;
  std::vector<bool> odd_;
};

}  // namespace mimicry
