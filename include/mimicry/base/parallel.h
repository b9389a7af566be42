#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string_view>

namespace mimicry {

/// More threads than this are never started.
inline constexpr int kMostThreads = 256;

/// Runs loops on a fixed number of threads, the caller's among them. For offline work (bake,
/// study); the drawing path takes none. Results depend on how a loop is cut into chunks and never
/// on the number of threads, provided that chunks write to places of their own.
class Executor {
 public:
  /// threads: 1 to kMostThreads; others count as the nearest. Where the platform has no threads
  /// (WebAssembly without pthreads) everything runs in the caller; where the system gives no more
  /// there are fewer: `threads()` says how many.
  explicit Executor(int threads = 1);
  ~Executor();
  Executor(const Executor&) = delete;
  Executor& operator=(const Executor&) = delete;

  int threads() const;

  /// Calls body(begin, end, worker) for the chunks [0, chunk), [chunk, 2 chunk) ... of [0, count);
  /// worker is in [0, threads()) and names the scratch that the call may use. Returns when all are
  /// done. The first exception (of the lowest chunk) is thrown again here; chunks that have not
  /// begun by then are left out. Calls do not nest.
  void for_chunks(std::size_t count, std::size_t chunk,
                  const std::function<void(std::size_t, std::size_t, int)>& body);

  /// Called in the thread that runs a loop, after each chunk that this thread has done; what it
  /// throws ends the loop as the exception of a chunk does. For work that can be cancelled.
  void set_between(std::function<void()> between);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// body(i) for each i of [0, count) on `threads` threads; one-off use of Executor.
void parallel_for(std::size_t count, int threads, const std::function<void(std::size_t)>& body);

/// How far a long piece of work has come. `stage` is one short word or two and serves as a name for
/// timing; `fraction` of that stage is in [0, 1].
struct Progress {
  std::string_view stage;
  double fraction = 0.0;
};
/// Called from the thread that started the work; false cancels it, which then throws
/// Error(cancelled). An empty function is fine.
using ProgressCallback = std::function<bool(const Progress&)>;

/// Reports and throws Error(cancelled) where the callback returns false.
void report(const ProgressCallback& callback, std::string_view stage, double fraction);

}  // namespace mimicry
