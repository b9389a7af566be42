#include "assets/work.h"

#include <algorithm>
#include <thread>

#include <mimicry/base/error.h>
#include <mimicry/base/parallel.h>

namespace mimicry {

void Monitor::tell(const std::string& sentence) const {
  if (note) note(sentence);
}

void Monitor::check() const {
  if (cancelled && cancelled()) throw Error(ErrorKind::cancelled, "interrupted");
}

void Monitor::report(std::string_view work, std::size_t done, std::size_t total) const {
  check();
  if (progress && total > 0)
    progress(work, std::min(static_cast<double>(done) / static_cast<double>(total), 1.0));
}

int thread_count(int threads) {
  const int hardware = static_cast<int>(std::thread::hardware_concurrency());
  return std::clamp(threads > 0 ? threads : hardware, 1, kMostThreads);
}

}  // namespace mimicry
