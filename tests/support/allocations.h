#pragma once

namespace mimicry::test {

/// Allocations through operator new so far. Only in programs that compile support/allocations.cpp.
long allocation_count();

/// From here on only `count` allocations succeed; all do again when it is gone.
class AllocationLimit {
 public:
  explicit AllocationLimit(long count);
  ~AllocationLimit();
  AllocationLimit(const AllocationLimit&) = delete;
  AllocationLimit& operator=(const AllocationLimit&) = delete;
};

}  // namespace mimicry::test
