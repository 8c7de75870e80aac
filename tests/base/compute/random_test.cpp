#include "base/compute/random.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <set>
#include <vector>

namespace throng {
namespace {

TEST(Random, IsPhilox4x32With10Rounds) {
  // Random123's known answer for key 0 and counter 0.
  Random random(0, Stream{0}, 0);
  EXPECT_EQ(random.bits(), 0x6627e8d5U);
  EXPECT_EQ(random.bits(), 0xe169c58dU);
  EXPECT_EQ(random.bits(), 0xbc57ac4cU);
  EXPECT_EQ(random.bits(), 0x9b00dbd8U);
}

TEST(Random, DependsOnSeedStreamAndIndexOnly) {
  const auto draw = [](std::uint64_t seed, Stream stream, std::uint64_t index) {
    return Random(seed, stream, index).bits();
  };
  // The same key gives the same value, independent of other samples.
  const std::uint32_t first = draw(7, Stream::motion, 3);
  Random(7, Stream::wind, 9).uniform();
  EXPECT_EQ(draw(7, Stream::motion, 3), first);

  const std::uint64_t high_bit = std::uint64_t{1} << 40;
  const std::set<std::uint32_t> different{first,
                                          draw(8, Stream::motion, 3),
                                          draw(7 + high_bit, Stream::motion, 3),
                                          draw(7, Stream::wind, 3),
                                          draw(7, Stream::motion, 4),
                                          draw(7, Stream::motion, 3 + high_bit)};
  EXPECT_EQ(different.size(), 6U);
}

TEST(Random, UniformFillsItsRangeEvenly) {
  constexpr double kBins = 20;
  constexpr int kDraws = 20'000;
  std::array<int, 20> counts{};
  double sum = 0;
  for (int i = 0; i < kDraws; ++i) {
    // One draw each of many generators: how agents use it.
    const double value =
        Random(1, Stream::appearance, static_cast<std::uint64_t>(i)).uniform(-2, 3);
    ASSERT_GE(value, -2);
    ASSERT_LT(value, 3);
    sum += value;
    ++counts[static_cast<std::size_t>((value + 2) / 5 * kBins)];
  }
  EXPECT_NEAR(sum / kDraws, 0.5, 0.04);
  double chi2 = 0;
  for (const int count : counts) {
    chi2 += std::pow(count - kDraws / kBins, 2) / (kDraws / kBins);
  }
  EXPECT_LT(chi2, 43.8);  // 0.1 % of the chi-square distribution with 19 degrees of freedom
}

TEST(Random, NormalHasItsMeanAndDeviation) {
  Random random(2, Stream::sensors);
  constexpr int kDraws = 20'000;
  double sum = 0;
  double squares = 0;
  int within_one_sd = 0;
  for (int i = 0; i < kDraws; ++i) {
    const double value = random.normal(5, 2);
    ASSERT_TRUE(std::isfinite(value));
    sum += value;
    squares += (value - 5) * (value - 5);
    within_one_sd += std::abs(value - 5) < 2 ? 1 : 0;
  }
  EXPECT_NEAR(sum / kDraws, 5, 0.06);
  EXPECT_NEAR(std::sqrt(squares / kDraws), 2, 0.05);
  EXPECT_NEAR(static_cast<double>(within_one_sd) / kDraws, 0.6827, 0.015);
}

TEST(Random, BelowReachesEveryValueAndNoOther) {
  Random random(3, Stream::crowd_behavior);
  std::vector<int> counts(6, 0);
  for (int i = 0; i < 6000; ++i) ++counts.at(random.below(6));
  for (const int count : counts) EXPECT_NEAR(count, 1000, 150);
  EXPECT_EQ(random.below(1), 0U);
}

TEST(DeriveSeed, GivesUnrelatedSeeds) {
  std::set<std::uint64_t> seeds;
  for (std::uint64_t run = 0; run < 1000; ++run) seeds.insert(derive_seed(42, Stream::run, run));
  EXPECT_EQ(seeds.size(), 1000U);
  EXPECT_EQ(derive_seed(42, Stream::run, 5), derive_seed(42, Stream::run, 5));
  EXPECT_NE(derive_seed(42, Stream::run, 5), derive_seed(43, Stream::run, 5));
}

}  // namespace
}  // namespace throng
