#pragma once

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <new>
#include <type_traits>
#include <vector>

namespace mimicry {

/// Types that are copied by copying their bytes: trivially copyable ones, and those that hold
/// Eigen's vectors of fixed size. No pointers to themselves, nothing to give back.
template <class T>
inline constexpr bool kIsPlain =
    std::is_trivially_destructible_v<T>&& std::is_copy_constructible_v<T> &&
    alignof(T) <= alignof(std::uint64_t);

/// Plain data of a size that is known when it is made, and of a type that only its technique knows:
/// the options and the memory of a technique. Copies are deep; assigning a block of the same size
/// does not allocate.
class Block {
 public:
  Block() = default;
  /// Zeros.
  explicit Block(std::size_t bytes) : words_((bytes + 7) / 8), size_(bytes) {}
  template <class T>
  static Block of(const T& value) {
    static_assert(kIsPlain<T>, "the data of a technique must be plain");
    Block block(sizeof(T));
    new (block.data()) T(value);
    return block;
  }

  bool empty() const { return size_ == 0; }
  std::size_t size() const { return size_; }  ///< bytes
  void* data() { return words_.data(); }
  const void* data() const { return words_.data(); }

  /// T: the type that the block was made of.
  template <class T>
  T& as() {
    assert(sizeof(T) == size_);
    return *std::launder(static_cast<T*>(data()));
  }
  template <class T>
  const T& as() const {
    assert(sizeof(T) == size_);
    return *std::launder(static_cast<const T*>(data()));
  }

 private:
  std::vector<std::uint64_t> words_;
  std::size_t size_ = 0;
};

}  // namespace mimicry
