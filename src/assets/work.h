#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>

namespace mimicry::assets {

/// How a caller follows long work and ends it. Every member may be empty. Each may be called from
/// any thread of the work, and by several at once; what it throws ends the work.
struct Monitor {
  /// A sentence for people: what was mended, taken from elsewhere or left out.
  std::function<void(const std::string& sentence)> note;
  /// work: "baking", "replaying"; fraction: of it, in [0, 1].
  std::function<void(std::string_view work, double fraction)> progress;
  /// True ends the work with Error(cancelled).
  std::function<bool()> cancelled;

  void tell(const std::string& sentence) const;
  /// Throws Error(cancelled) where the work is to end.
  void check() const;
  /// Reports, and does as `check`. Where `total` is 0 all is done.
  void report(std::string_view work, std::size_t done, std::size_t total) const;
};

/// `threads`, or as many as the machine has for 0; from 1 to kMostThreads.
int thread_count(int threads);

}  // namespace mimicry::assets
