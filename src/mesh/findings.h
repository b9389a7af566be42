#pragma once

#include <mimicry/base/types.h>

namespace mimicry {

/// One more of what a report counts; its example is the one with the lowest number.
template <class Finding>
void note(Finding& finding, Index i) {
  if (finding.count++ == 0 || i < finding.first) finding.first = i;
}

}  // namespace mimicry
