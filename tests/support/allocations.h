#pragma once

namespace mimicry::test {

/// Allocations through operator new so far. Only in programs that compile support/allocations.cpp.
long allocation_count();

}  // namespace mimicry::test
