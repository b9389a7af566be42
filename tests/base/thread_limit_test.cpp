// This program's own pthread_create stands before the system's, so that threads can be refused.
#if !defined(__EMSCRIPTEN__) && !defined(_WIN32)

#include <atomic>
#include <cerrno>
#include <vector>

#include <dlfcn.h>
#include <gtest/gtest.h>
#include <pthread.h>

#include <mimicry/base/parallel.h>

#include "base/ordered_work.h"

namespace {
std::atomic<int> threads_left{1 << 20};
}

extern "C" int pthread_create(pthread_t* thread, const pthread_attr_t* attributes,
                              void* (*start)(void*), void* argument) noexcept {
  using Create = int (*)(pthread_t*, const pthread_attr_t*, void* (*)(void*), void*);
  static const auto create = reinterpret_cast<Create>(dlsym(RTLD_NEXT, "pthread_create"));
  if (--threads_left < 0) return EAGAIN;
  return create(thread, attributes, start, argument);
}

namespace mimicry {
namespace {

/// The system gives this many threads while it lives.
struct ThreadLimit {
  explicit ThreadLimit(int most) { threads_left = most; }
  ~ThreadLimit() { threads_left = 1 << 20; }
};

TEST(ThreadLimit, ExecutorTakesTheThreadsThatThereAre) {
  for (const int most : {0, 1, 3}) {
    const ThreadLimit limit(most);
    Executor executor(8);
    EXPECT_EQ(executor.threads(), most + 1);
    std::vector<int> visits(1000, 0);
    executor.for_chunks(visits.size(), 7, [&](std::size_t begin, std::size_t end, int worker) {
      ASSERT_TRUE(worker >= 0 && worker < executor.threads());
      for (std::size_t i = begin; i < end; ++i) ++visits[i];
    });
    for (const int v : visits) EXPECT_EQ(v, 1);
  }
}

TEST(ThreadLimit, OrderedWorkIsDone) {
  for (const int most : {0, 1, 3}) {
    const ThreadLimit limit(most);
    int given = 0;
    std::vector<int> results;
    work_in_order(
        8, 4,
        [&]() -> std::optional<int> { return given < 500 ? std::optional(given++) : std::nullopt; },
        [](int job) { return 2 * job; }, [&](int result) { results.push_back(result); });
    ASSERT_EQ(results.size(), 500u);
    for (int i = 0; i < 500; ++i) EXPECT_EQ(results[static_cast<std::size_t>(i)], 2 * i);
  }
}

TEST(ThreadLimit, AbsurdNumbersAreClamped) {
  const ThreadLimit limit(kMostThreads + 10);
  EXPECT_EQ(Executor(2'000'000'000).threads(), kMostThreads);
  EXPECT_EQ(Executor(-5).threads(), 1);
}

}  // namespace
}  // namespace mimicry

#endif
