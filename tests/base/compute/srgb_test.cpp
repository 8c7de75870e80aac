#include "base/compute/srgb.h"

#include <gtest/gtest.h>

#include <limits>

namespace throng {
namespace {

TEST(Srgb, BytesComeBack) {
  for (int byte = 0; byte < 256; ++byte) {
    EXPECT_EQ(srgb_from_linear(linear_from_srgb(static_cast<std::uint8_t>(byte))), byte);
  }
}

TEST(Srgb, HalfOfTheLightIsBrighterThanTheMiddle) {
  EXPECT_NEAR(linear_from_srgb(188), 0.5028, 1e-4);
}

TEST(Srgb, LightIsClipped) {
  EXPECT_EQ(srgb_from_linear(-1), 0);
  EXPECT_EQ(srgb_from_linear(7), 255);
  EXPECT_EQ(srgb_from_linear(std::numeric_limits<float>::quiet_NaN()), 0);
}

}  // namespace
}  // namespace throng
