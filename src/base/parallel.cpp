#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <new>
#include <string>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include <mimicry/base/error.h>
#include <mimicry/base/parallel.h>

namespace mimicry {

#if defined(__EMSCRIPTEN__) && !defined(__EMSCRIPTEN_PTHREADS__)
#define MIMICRY_NO_THREADS 1
#endif

struct Executor::State {
  std::vector<std::thread> pool;
  std::mutex mutex;
  std::condition_variable wake;
  std::condition_variable done;
  std::size_t generation = 0;
  std::size_t busy = 0;
  bool stop = false;

  std::function<void()> between;

  // The loop under way.
  const std::function<void(std::size_t, std::size_t, int)>* body = nullptr;
  std::size_t count = 0;
  std::size_t chunk = 1;
  std::atomic<std::size_t> next{0};
  std::atomic<bool> failed{false};
  std::exception_ptr error;
  std::size_t error_chunk = 0;

  void work(int worker) {
    while (!failed.load(std::memory_order_relaxed)) {
      const std::size_t begin = next.fetch_add(1, std::memory_order_relaxed) * chunk;
      if (begin >= count) return;
      try {
        (*body)(begin, std::min(begin + chunk, count), worker);
        if (worker == 0 && between) between();
      } catch (...) {
        const std::lock_guard lock(mutex);
        if (!error || begin < error_chunk) {
          error = std::current_exception();
          error_chunk = begin;
        }
        failed.store(true, std::memory_order_relaxed);
      }
    }
  }

  void serve(int worker) {
    std::size_t seen = 0;
    while (true) {
      {
        std::unique_lock lock(mutex);
        wake.wait(lock, [&] { return stop || generation != seen; });
        if (stop) return;
        seen = generation;
      }
      work(worker);
      const std::lock_guard lock(mutex);
      if (--busy == 0) done.notify_one();
    }
  }
};

Executor::Executor(int threads) : state_(std::make_unique<State>()) {
#ifndef MIMICRY_NO_THREADS
  threads = std::min(threads, kMostThreads);
  // Before the first thread starts: what throws later would leave threads that nobody joins.
  state_->pool.reserve(static_cast<std::size_t>(std::max(threads, 1)));
  try {
    for (int t = 1; t < threads; ++t)
      state_->pool.emplace_back([state = state_.get(), t] { state->serve(t); });
  } catch (const std::system_error&) {  // a limit of the process, user or container
  } catch (const std::bad_alloc&) {
  }
#else
  (void)threads;
#endif
}

Executor::~Executor() {
  {
    const std::lock_guard lock(state_->mutex);
    state_->stop = true;
  }
  state_->wake.notify_all();
  for (std::thread& t : state_->pool) t.join();
}

int Executor::threads() const {
  return static_cast<int>(state_->pool.size()) + 1;
}

void Executor::set_between(std::function<void()> between) {
  state_->between = std::move(between);
}

void Executor::for_chunks(std::size_t count, std::size_t chunk,
                          const std::function<void(std::size_t, std::size_t, int)>& body) {
  chunk = std::max<std::size_t>(chunk, 1);
  if (state_->pool.empty() || count <= chunk) {
    for (std::size_t begin = 0; begin < count; begin += chunk) {
      body(begin, std::min(begin + chunk, count), 0);
      if (state_->between) state_->between();
    }
    return;
  }
  State& s = *state_;
  {
    const std::lock_guard lock(s.mutex);
    s.body = &body;
    s.count = count;
    s.chunk = chunk;
    s.next.store(0, std::memory_order_relaxed);
    s.failed.store(false, std::memory_order_relaxed);
    s.error = nullptr;
    s.busy = s.pool.size();
    ++s.generation;
  }
  s.wake.notify_all();
  s.work(0);
  std::unique_lock lock(s.mutex);
  s.done.wait(lock, [&] { return s.busy == 0; });
  if (s.error) std::rethrow_exception(std::exchange(s.error, nullptr));
}

void parallel_for(std::size_t count, int threads, const std::function<void(std::size_t)>& body) {
  Executor executor(threads);
  executor.for_chunks(count, 1, [&](std::size_t begin, std::size_t end, int) {
    for (std::size_t i = begin; i < end; ++i) body(i);
  });
}

void report(const ProgressCallback& callback, std::string_view stage, double fraction) {
  if (callback && !callback({stage, fraction}))
    throw Error(ErrorKind::cancelled, "cancelled during " + std::string(stage));
}

}  // namespace mimicry
