#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <mimicry/base/error.h>
#include <mimicry/base/random.h>
#include <mimicry/base/types.h>
#include <mimicry/study/comparison.h>

#include "study/holm.h"
#include "study/normal_distribution.h"

namespace mimicry {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

std::vector<double> zeros(std::size_t n) {
  return std::vector<double>(n, 0.0);
}

TEST(NormalDistribution, KnownValues) {
  EXPECT_NEAR(normal_cdf(1.959963984540054), 0.975, 1e-15);
  EXPECT_NEAR(normal_cdf(-10) / 7.619853024160527e-24, 1, 1e-12);
  EXPECT_NEAR(normal_quantile(1e-10), -6.361340902404056, 1e-12);
  EXPECT_NEAR(normal_quantile(0.01), -2.3263478740408408, 1e-14);
  EXPECT_NEAR(normal_quantile(0.7), 0.52440051270804067, 1e-14);
  EXPECT_EQ(normal_quantile(0.5), 0.0);
  EXPECT_EQ(normal_quantile(0), -kInfinity);
  EXPECT_EQ(normal_quantile(1), kInfinity);
  for (double p = 1e-6; p < 1; p += 0.01) EXPECT_NEAR(normal_cdf(normal_quantile(p)), p, 1e-14);
}

// Hollander and Wolfe, Nonparametric Statistical Methods (1973), p. 29: depression scores.
TEST(Wilcoxon, HollanderAndWolfe) {
  const std::vector<double> a = {1.83, 0.50, 1.62, 2.48, 1.68, 1.88, 1.55, 3.06, 1.30};
  const std::vector<double> b = {0.878, 0.647, 0.598, 2.05, 1.06, 1.29, 1.06, 3.14, 1.29};
  const WilcoxonResult r = wilcoxon_signed_rank(a, b);
  EXPECT_EQ(r.w_plus, 40);
  EXPECT_EQ(r.w_minus, 5);
  ASSERT_TRUE(r.p_exact);
  EXPECT_DOUBLE_EQ(*r.p_exact, 0.0390625);
  EXPECT_NEAR(r.p_normal, 0.03815171, 1e-8);
  EXPECT_DOUBLE_EQ(r.rank_biserial, 35.0 / 45);
  EXPECT_DOUBLE_EQ(r.effect_r, r.z / 3);
}

// Darwin, The Effects of Cross and Self Fertilisation (1876), maize, eighths of an inch.
TEST(Wilcoxon, DarwinsMaize) {
  const std::vector<double> d = {49, -67, 8, 16, 6, 23, 28, 41, 14, 29, 56, 24, 75, 60, -48};
  const WilcoxonResult r = wilcoxon_signed_rank(d, zeros(d.size()));
  EXPECT_EQ(r.w_plus, 96);
  ASSERT_TRUE(r.p_exact);
  EXPECT_NEAR(*r.p_exact, 0.04126, 5e-6);
}

// Pairs of Lowry's example: one without a difference, two differences equally large three times.
TEST(Wilcoxon, TiesAndZeros) {
  const std::vector<double> a = {125, 115, 130, 140, 140, 115, 140, 125, 140, 135};
  const std::vector<double> b = {110, 122, 125, 120, 140, 124, 123, 137, 135, 145};
  const WilcoxonResult r = wilcoxon_signed_rank(a, b);
  EXPECT_EQ(r.pairs, 10);
  EXPECT_EQ(r.differences, 9);
  EXPECT_TRUE(r.ties);
  EXPECT_FALSE(r.p_exact);
  EXPECT_EQ(r.w_plus, 27);
  EXPECT_EQ(r.w_minus, 18);
  // (27 - 22.5) / sqrt((9 10 19 - (2^3 - 2) / 2) / 24)
  EXPECT_DOUBLE_EQ(r.z, 4.5 / std::sqrt((9.0 * 10 * 19 - 3) / 24));
}

TEST(Wilcoxon, PrattRanksZeros) {
  const std::vector<double> d = {0, 0, 1, -2, 3};  // ranks 3, 4, 5 are left
  const WilcoxonResult r =
      wilcoxon_signed_rank(d, zeros(d.size()), {.zeros = ZeroDifferences::ranked});
  EXPECT_EQ(r.w_plus, 8);
  EXPECT_EQ(r.w_minus, 4);
  EXPECT_DOUBLE_EQ(r.z, (8 - 6) / std::sqrt((9 + 16 + 25) / 4.0));
  EXPECT_FALSE(r.p_exact);
}

TEST(Wilcoxon, ExactCountsEverySignPattern) {
  Random random(5);
  for (int n = 1; n <= 12; ++n) {
    std::vector<double> d;
    for (int i = 0; i < n; ++i) d.push_back(random.normal());
    const WilcoxonResult r = wilcoxon_signed_rank(d, zeros(d.size()));
    const double off = std::abs(r.w_plus - r.w_minus);
    int as_far = 0;
    for (int pattern = 0; pattern < (1 << n); ++pattern) {
      int w = 0;
      for (int rank = 1; rank <= n; ++rank) w += ((pattern >> (rank - 1)) & 1) != 0 ? rank : -rank;
      as_far += std::abs(w) >= off ? 1 : 0;
    }
    ASSERT_TRUE(r.p_exact);
    EXPECT_DOUBLE_EQ(*r.p_exact, as_far / static_cast<double>(1 << n)) << n;
  }
}

TEST(Wilcoxon, SwappingTurnsTheSign) {
  const std::vector<double> a = {3, 1, 4, 1, 5, 9, 2, 6}, b = {2, 7, 1, 8, 2, 8, 1, 8};
  const WilcoxonResult ab = wilcoxon_signed_rank(a, b), ba = wilcoxon_signed_rank(b, a);
  EXPECT_EQ(ab.z, -ba.z);
  EXPECT_EQ(ab.p(), ba.p());
  EXPECT_EQ(ab.rank_biserial, -ba.rank_biserial);
}

TEST(Wilcoxon, NothingToTell) {
  const std::vector<double> a = {1, 2, 3};
  const WilcoxonResult r = wilcoxon_signed_rank(a, a);
  EXPECT_EQ(r.z, 0);
  EXPECT_EQ(r.p(), 1);
  EXPECT_EQ(wilcoxon_signed_rank({}, {}).p(), 1);
  EXPECT_THROW(wilcoxon_signed_rank(a, zeros(2)), Error);
  EXPECT_THROW(wilcoxon_signed_rank(a, std::vector<double>{1, kNan, 1}), Error);
}

// Holm, A Simple Sequentially Rejective Multiple Test Procedure (1979): the procedure's own steps.
TEST(Holm, Steps) {
  EXPECT_THAT(
      holm_adjusted(std::vector<double>{.01, .04, .03, .005, .5}),
      testing::Pointwise(testing::DoubleNear(1e-15), std::vector<double>{.04, .09, .09, .025, .5}));
  const std::vector<double> some = holm_adjusted(std::vector<double>{.6, kNan, .7});
  EXPECT_EQ(some[0], 1);
  EXPECT_TRUE(std::isnan(some[1]));
  EXPECT_EQ(some[2], 1);
}

// Efron and Tibshirani, An Introduction to the Bootstrap (1993), tables 14.1 and 14.2: the
// variance of 26 spatial scores, 90 % intervals.
TEST(Bootstrap, EfronAndTibshirani) {
  const std::vector<double> scores = {48, 36, 20, 29, 42, 42, 20, 42, 22, 41, 45, 14, 6,
                                      0,  33, 28, 34, 4,  32, 24, 47, 41, 24, 26, 30, 41};
  const auto variance = [](std::span<const double> x) {
    const double n = static_cast<double>(x.size()), s = standard_deviation(x);
    return s * s * (n - 1) / n;
  };
  EXPECT_NEAR(variance(scores), 171.5, 0.05);
  // The book drew 2,000 samples; its ends and ours differ by the luck of the draw, about 2 %.
  const Interval p = bootstrap_interval(
      scores, variance, {.kind = BootstrapKind::percentile, .resamples = 20000, .level = 0.9});
  EXPECT_NEAR(p.low, 100.8, 3);
  EXPECT_NEAR(p.high, 233.9, 5);
  const Interval bca = bootstrap_interval(scores, variance, {.resamples = 20000, .level = 0.9});
  EXPECT_NEAR(bca.low, 115.8, 3);
  EXPECT_NEAR(bca.high, 259.6, 5);
}

TEST(Bootstrap, CoversTheMeanAsOftenAsItSays) {
  // 200 samples of 30 skewed values: a 90 % interval covers within 3 deviations (2.1 % each) and
  // the couple of per cent that so few values cost.
  Random random(11);
  int covered = 0;
  for (int k = 0; k < 200; ++k) {
    std::vector<double> x;
    for (int i = 0; i < 30; ++i) x.push_back(-std::log(1 - random.uniform()));
    const Interval i = bootstrap_interval(
        x, mean, {.resamples = 500, .level = 0.9, .seed = static_cast<std::uint64_t>(k)});
    covered += i.low <= 1 && 1 <= i.high ? 1 : 0;
  }
  EXPECT_GT(covered, 160);
  EXPECT_LT(covered, 195);
}

TEST(Bootstrap, SameSeedSameBitsAndFewValues) {
  const std::vector<double> x = {1, 5, 2, 8, 4};
  const Interval a = bootstrap_interval(x, mean), b = bootstrap_interval(x, mean);
  EXPECT_EQ(a.low, b.low);
  EXPECT_EQ(a.high, b.high);
  EXPECT_LT(a.low, mean(x));
  EXPECT_GT(a.high, mean(x));
  const Interval one = bootstrap_interval(std::vector<double>{3}, mean);
  EXPECT_EQ(one.low, 3);
  EXPECT_EQ(one.high, 3);
  EXPECT_THROW(bootstrap_interval({}, mean), Error);
  EXPECT_THROW(bootstrap_interval(x, mean, {.level = 1.5}), Error);
  EXPECT_THROW(bootstrap_interval(x, mean, {.resamples = 3}), Error);
  EXPECT_THROW(bootstrap_interval(std::vector<double>{1, kNan}, mean), Error);
}

TEST(Comparison, ParticipantsMeansAreTestedBesideStrokes) {
  // Six people, of whom each has 20 strokes that are alike: five gain 1, one loses 2. Over strokes
  // that is overwhelming; over people it is next to nothing.
  Random random(17);
  PairedMeasure measure{"K_E", {}, {}, {}};
  std::vector<double> mean_a(6), mean_b(6);
  for (std::size_t person = 0; person < 6; ++person)
    for (int k = 0; k < 20; ++k) {
      const double a = 5.0 + random.normal();
      const double b = a - (person < 5 ? 1.0 : -2.0) + 0.1 * random.normal();
      measure.a.push_back(a);
      measure.b.push_back(b);
      measure.participants.push_back(10 * person);
      mean_a[person] += a / 20;
      mean_b[person] += b / 20;
    }
  const Comparison c = compare({&measure, 1}).front();
  EXPECT_LT(c.test.p(), 1e-3);
  EXPECT_EQ(c.participants, 6);
  // Ranks 1 to 5 of 6 are positive: of 64 sets of signs, 2 x 14 are as far off or farther.
  EXPECT_EQ(c.by_participant.w_plus, 15);
  EXPECT_DOUBLE_EQ(c.by_participant.p(), 28.0 / 64);
  EXPECT_EQ(c.by_participant.p(), wilcoxon_signed_rank(mean_a, mean_b).p());
  // Pairs without a number on both sides do not count for anyone.
  measure.a[0] = kNan;
  for (std::size_t i = 100; i < 120; ++i) measure.b[i] = kNan;
  EXPECT_EQ(compare({&measure, 1}).front().participants, 5);
  measure.participants.clear();
  EXPECT_EQ(compare({&measure, 1}).front().participants, 0);
  measure.participants.resize(3);
  EXPECT_THROW(compare({&measure, 1}), Error);
}

TEST(Bootstrap, Moments) {
  const std::vector<double> x = {2, 4, 4, 4, 5, 5, 7, 9};
  EXPECT_EQ(mean(x), 5);
  EXPECT_DOUBLE_EQ(standard_deviation(x), std::sqrt(32.0 / 7));
  EXPECT_EQ(median(x), 4.5);
  EXPECT_TRUE(std::isnan(mean({})));
  EXPECT_TRUE(std::isnan(standard_deviation(std::vector<double>{1})));
  EXPECT_TRUE(std::isnan(median({})));
}

}  // namespace
}  // namespace mimicry
