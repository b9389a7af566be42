#include "bake/incomplete_cholesky.h"

#include <algorithm>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace mimicry {
namespace {

double value(const IncompleteCholesky::Applied& z, std::size_t i, std::size_t c) {
  return static_cast<double>(z.row(i, c / z.width)[c % z.width]);
}

std::vector<double> random_block(std::size_t rows, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  std::vector<double> block(rows * kBlock);
  for (double& b : block) b = number(random);
  return block;
}

// 1 on the diagonal and `beside` next to it: the factor has no other entries.
UpperRows chain(Index rows, float beside) {
  UpperRows a;
  for (Index i = 0; i < rows; ++i) {
    a.column.push_back(i);
    a.value.push_back(1.0F);
    if (i + 1 < rows) {
      a.column.push_back(i + 1);
      a.value.push_back(beside);
    }
    a.start.push_back(static_cast<Index>(a.column.size()));
  }
  return a;
}

TEST(IncompleteCholesky, OfAChainIsItsWholeFactor) {
  constexpr Index kRows = 500;
  constexpr float kBeside = -0.4F;
  const IncompleteCholesky factor(chain(kRows, kBeside));
  const std::vector<double> r = random_block(kRows, 1);
  IncompleteCholesky::Applied z;
  Executor executor(1);
  factor.apply(r, z, executor);
  const auto diagonal = 1.0 + static_cast<double>(factor.shift());
  for (std::size_t i = 0; i < kRows; ++i)
    for (std::size_t c = 0; c < kBlock; ++c) {
      double product = diagonal * value(z, i, c);
      if (i > 0) product += static_cast<double>(kBeside) * value(z, i - 1, c);
      if (i + 1 < kRows) product += static_cast<double>(kBeside) * value(z, i + 1, c);
      EXPECT_NEAR(product, r[i * kBlock + c], 5e-6);  // single precision, a condition of 9
    }
}

TEST(IncompleteCholesky, ShiftsAnIndefiniteMatrixUntilItIsNot) {
  // Eigenvalues 2.5 and -0.5.
  const IncompleteCholesky factor(chain(2, 1.5F));
  EXPECT_GT(factor.shift(), 0.5F);
  EXPECT_LE(factor.shift(), 1.0F);  // it is doubled at a time
}

TEST(IncompleteCholesky, ThreadsDoNotChangeTheBits) {
  // Entries at random distances, so that there is fill to choose from.
  constexpr Index kRows = 3000;
  std::mt19937 random(2);
  UpperRows a;
  for (Index i = 0; i < kRows; ++i) {
    a.column.push_back(i);
    a.value.push_back(1.0F);
    for (Index j = i + 1; j < std::min(i + 40, kRows); ++j)
      if (random() % 8 == 0) {
        a.column.push_back(j);
        a.value.push_back(-0.08F);
      }
    a.start.push_back(static_cast<Index>(a.column.size()));
  }
  const IncompleteCholesky factor(a);
  const std::vector<double> r = random_block(kRows, 3);
  IncompleteCholesky::Applied one;
  Executor alone(1);
  factor.apply(r, one, alone);
  for (const int threads : {2, 5}) {
    IncompleteCholesky::Applied many;
    Executor executor(threads);
    factor.apply(r, many, executor);
    for (std::size_t i = 0; i < kRows; ++i)
      for (std::size_t c = 0; c < kBlock; ++c)
        ASSERT_EQ(value(one, i, c), value(many, i, c)) << threads << " threads, row " << i;
  }
}

}  // namespace
}  // namespace mimicry
