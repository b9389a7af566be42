#include "base/ordered_work.h"

#include <atomic>
#include <chrono>
#include <optional>
#include <stdexcept>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

namespace mimicry {
namespace {

// 0, 1, 2 ... count - 1.
class Numbers {
 public:
  explicit Numbers(int count) : count_(count) {}
  std::optional<int> operator()() {
    if (at_ == count_) return std::nullopt;
    return at_++;
  }

 private:
  int count_, at_ = 0;
};

// Later jobs are faster, so that results come out of order.
int square(int i) {
  std::this_thread::sleep_for(std::chrono::microseconds(50 * (7 - i % 8)));
  return i * i;
}

TEST(WorkInOrder, ResultsComeInTheOrderOfTheJobs) {
  for (const int threads : {1, 2, 5})
    for (const int count : {0, 1, 3, 200}) {
      Numbers numbers(count);
      std::vector<int> results;
      work_in_order(
          threads, 16, [&] { return numbers(); }, square, [&](int r) { results.push_back(r); });
      ASSERT_EQ(results.size(), static_cast<std::size_t>(count));
      for (int i = 0; i < count; ++i) EXPECT_EQ(results[static_cast<std::size_t>(i)], i * i);
    }
}

TEST(WorkInOrder, IsNeverFartherAheadThanAllowed) {
  Numbers numbers(300);
  std::atomic<int> taken = 0, done = 0;
  work_in_order(
      4, 6,
      [&] {
        EXPECT_LT(taken - done, 6);
        std::optional<int> next = numbers();
        if (next) ++taken;
        return next;
      },
      square, [&](int) { ++done; });
  EXPECT_EQ(done, 300);
}

TEST(WorkInOrder, HandsOnWhatIsThrownAnywhere) {
  for (const int threads : {1, 3})
    for (int place = 0; place < 3; ++place) {
      Numbers numbers(100);
      std::vector<int> results;
      const auto trip = [&](int at, int i) {
        if (at == place && i == 20) throw std::runtime_error("twenty");
      };
      EXPECT_THROW(work_in_order(
                       threads, 8,
                       [&] {
                         const std::optional<int> i = numbers();
                         if (i) trip(0, *i);
                         return i;
                       },
                       [&](int i) {
                         trip(1, i);
                         return i;
                       },
                       [&](int i) {
                         trip(2, i);
                         results.push_back(i);
                       }),
                   std::runtime_error);
      // What was handed over is whole from the first on.
      EXPECT_LE(results.size(), 20U);
      for (std::size_t i = 0; i < results.size(); ++i) EXPECT_EQ(results[i], static_cast<int>(i));
    }
}

}  // namespace
}  // namespace mimicry
