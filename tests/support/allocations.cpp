#include "support/allocations.h"

#include <atomic>
#include <cstdlib>
#include <limits>
#include <new>

#if defined(_WIN32)
#include <malloc.h>
#endif

namespace {

std::atomic<long> allocations = 0;
std::atomic<long> end = std::numeric_limits<long>::max();

void* counted(std::size_t size) {
  if (++allocations > end) return nullptr;
  return std::malloc(size == 0 ? 1 : size);
}

void* counted(std::size_t size, std::align_val_t alignment) {
  if (++allocations > end) return nullptr;
  const auto align = static_cast<std::size_t>(alignment);
#if defined(_WIN32)
  return _aligned_malloc(size, align);
#else
  return std::aligned_alloc(align, (size + align - 1) / align * align);
#endif
}

void free_aligned(void* p) {
#if defined(_WIN32)
  _aligned_free(p);
#else
  std::free(p);
#endif
}

void* or_throw(void* p) {
  if (p == nullptr) throw std::bad_alloc();
  return p;
}

}  // namespace

long mimicry::test::allocation_count() {
  return allocations;
}

mimicry::test::AllocationLimit::AllocationLimit(long count) {
  end = allocations + count;
}

mimicry::test::AllocationLimit::~AllocationLimit() {
  end = std::numeric_limits<long>::max();
}

// Every form that pairs with another: a sanitizer notices a mixture with the library's own.
void* operator new(std::size_t size) {
  return or_throw(counted(size));
}
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  return counted(size);
}
void* operator new(std::size_t size, std::align_val_t alignment) {
  return or_throw(counted(size, alignment));
}
void operator delete(void* p) noexcept {
  std::free(p);
}
void operator delete(void* p, std::size_t) noexcept {
  std::free(p);
}
void operator delete(void* p, const std::nothrow_t&) noexcept {
  std::free(p);
}
void operator delete(void* p, std::align_val_t) noexcept {
  free_aligned(p);
}
void operator delete(void* p, std::size_t, std::align_val_t) noexcept {
  free_aligned(p);
}
