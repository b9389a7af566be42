#pragma once

#include <cstddef>
#include <cstdlib>
#include <limits>
#include <new>
#include <vector>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace mimicry {

/// Memory for arrays of many megabytes in large pages, where the system has them on request
/// (Linux): filling such an array for the first time then costs no fault for each of its 4 kB,
/// but one for each 2 MB. Smaller arrays are as usual.
template <class T>
struct LargeAllocator {
  using value_type = T;

  LargeAllocator() = default;
  template <class U>
  LargeAllocator(const LargeAllocator<U>&) {}

  T* allocate(std::size_t count) {
    if (count > std::numeric_limits<std::size_t>::max() / sizeof(T)) throw std::bad_alloc();
    std::size_t size = count * sizeof(T);
    const std::size_t alignment = size >= kLarge ? kPage : alignof(T);
    if (size >= kLarge) size = (size + kPage - 1) / kPage * kPage;
    void* const memory = ::operator new(size, std::align_val_t(alignment));
#ifdef __linux__
    if (size >= kLarge) ::madvise(memory, size, MADV_HUGEPAGE);  // a wish: failing costs nothing
#endif
    return static_cast<T*>(memory);
  }
  void deallocate(T* memory, std::size_t count) {
    const bool is_large = count * sizeof(T) >= kLarge;
    ::operator delete(memory, std::align_val_t(is_large ? kPage : alignof(T)));
  }
  template <class U>
  bool operator==(const LargeAllocator<U>&) const {
    return true;
  }

 private:
  static constexpr std::size_t kPage = std::size_t{1} << 21, kLarge = 2 * kPage;
};

template <class T>
using LargeVector = std::vector<T, LargeAllocator<T>>;

}  // namespace mimicry
