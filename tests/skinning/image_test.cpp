#include "skinning/image.h"

#include <gtest/gtest.h>

#include "tests/skinning/made_up.h"

namespace throng::skinning {
namespace {

TEST(Image, ShrinkingKeepsAPlainColor) {
  const Image small = resized(plain(512, {180, 90, 30}), 64);
  EXPECT_EQ(small.rgba, plain(64, {180, 90, 30}).rgba);
}

TEST(Image, ShrinkingWeighsColorsByTheirAlpha) {
  Image image = plain(2, {200, 0, 0});
  for (const std::size_t pixel : {1, 2, 3}) {
    image.rgba[4 * pixel] = 0;
    image.rgba[4 * pixel + 3] = 0;
  }
  const Image small = resized(image, 1);
  EXPECT_GE(small.rgba[0], 199);
  EXPECT_EQ(small.rgba[3], 64);
}

TEST(Image, UncoveredPixelsTakeTheNearestColor) {
  Image image(9, 1);
  Mask covered(9, 0);
  covered[0] = covered[8] = 1;
  image.pixel(0, 0)[0] = 100;
  image.pixel(8, 0)[0] = 200;
  fill_from_nearest(image, covered);
  EXPECT_EQ(image.pixel(3, 0)[0], 100);
  EXPECT_EQ(image.pixel(5, 0)[0], 200);
}

}  // namespace
}  // namespace throng::skinning
