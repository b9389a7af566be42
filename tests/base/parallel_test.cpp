#include <atomic>
#include <chrono>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include <mimicry/base/error.h>
#include <mimicry/base/parallel.h>

namespace mimicry {
namespace {

TEST(Executor, EveryIndexOnceInChunksOfTheirOwn) {
  for (const int threads : {1, 2, 5}) {
    Executor executor(threads);
    EXPECT_GE(executor.threads(), 1);
    for (const std::size_t count : {0u, 1u, 7u, 1000u}) {
      std::vector<int> visits(count, 0);
      executor.for_chunks(count, 8, [&](std::size_t begin, std::size_t end, int worker) {
        ASSERT_EQ(begin % 8, 0u);
        ASSERT_LE(end - begin, 8u);
        ASSERT_TRUE(worker >= 0 && worker < executor.threads());
        for (std::size_t i = begin; i < end; ++i) ++visits[i];
      });
      for (const int v : visits) EXPECT_EQ(v, 1);
    }
  }
}

TEST(Executor, ServesManyLoopsOneAfterTheOther) {
  Executor executor(3);
  std::vector<long> sum(64, 0);
  for (int loop = 0; loop < 300; ++loop)
    executor.for_chunks(sum.size(), 1, [&](std::size_t i, std::size_t, int) { sum[i] += loop; });
  for (const long s : sum) EXPECT_EQ(s, 299 * 300 / 2);
}

TEST(Executor, HandsOnExceptionsAndLivesOn) {
  for (const int threads : {1, 3}) {
    Executor executor(threads);
    const auto fail = [](std::size_t begin, std::size_t, int) {
      if (begin == 5) throw std::runtime_error("five");
    };
    EXPECT_THROW(executor.for_chunks(100, 1, fail), std::runtime_error);
    std::atomic<int> count = 0;
    executor.for_chunks(10, 1, [&](std::size_t, std::size_t, int) { ++count; });
    EXPECT_EQ(count, 10);
  }
}

TEST(Executor, LoopsEndWhereTheirThreadIsToldSoBetweenChunks) {
  const std::thread::id caller = std::this_thread::get_id();
  for (const int threads : {1, 3}) {
    Executor executor(threads);
    int asked = 0;
    executor.set_between([&] {
      EXPECT_EQ(std::this_thread::get_id(), caller);
      if (++asked == 3) throw Error(ErrorKind::cancelled, "enough");
    });
    std::atomic<int> count = 0;
    // The other threads leave work for the caller.
    const auto slowly = [&](std::size_t, std::size_t, int worker) {
      ++count;
      if (worker != 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    };
    EXPECT_THROW(executor.for_chunks(100'000, 1, slowly), Error);
    EXPECT_EQ(asked, 3);
    EXPECT_LT(count, 100'000);
    executor.set_between({});
    EXPECT_NO_THROW(executor.for_chunks(10, 1, slowly));
  }
}

TEST(Executor, ParallelForVisitsAll) {
  std::vector<int> visits(100, 0);
  parallel_for(visits.size(), 2, [&](std::size_t i) { visits[i] = static_cast<int>(i); });
  for (std::size_t i = 0; i < visits.size(); ++i) EXPECT_EQ(visits[i], static_cast<int>(i));
}

TEST(Progress, FalseCancels) {
  EXPECT_NO_THROW(report({}, "stage", 0.5));
  EXPECT_NO_THROW(report([](const Progress&) { return true; }, "stage", 0.5));
  try {
    report([](const Progress& p) { return p.stage != "mds"; }, "mds", 0.5);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::cancelled);
  }
}

}  // namespace
}  // namespace mimicry
