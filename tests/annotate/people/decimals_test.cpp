#include "annotate/people/decimals.h"

#include <gtest/gtest.h>

#include <random>
#include <string>

namespace throng::annotate {
namespace {

std::string written(double value, int decimals) {
  std::string text;
  append_decimal(text, value, decimals);
  return text;
}

TEST(Decimals, LastZerosAreLeftOut) {
  EXPECT_EQ(written(12.3, 2), "12.3");
  EXPECT_EQ(written(-0.004, 2), "0");
  EXPECT_EQ(written(-0.006, 2), "-0.01");
  EXPECT_EQ(written(1000, 3), "1000");
}

TEST(Decimals, RoundedIsTheValueThatAReaderGets) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> values(-5000, 5000);
  for (int i = 0; i < 100'000; ++i) {
    const double value = values(random);
    for (const int decimals : {0, 2, 3}) {
      ASSERT_EQ(rounded(value, decimals), std::stod(written(value, decimals))) << value;
    }
  }
}

}  // namespace
}  // namespace throng::annotate
