#pragma once

#include <mimicry/assets/canvas.h>

namespace mimicry {

/// `threads`, or as many as the machine has for 0; from 1 to kMostThreads.
int thread_count(int threads);

}  // namespace mimicry
