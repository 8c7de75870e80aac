#include "skinning/body/skin_tone.h"

#include <gtest/gtest.h>

namespace throng::skinning {
namespace {

Image plain(std::uint8_t red, std::uint8_t green, std::uint8_t blue) {
  Image image(4, 4);
  for (int i = 0; i < 16; ++i) {
    std::uint8_t* pixel = image.pixel(i % 4, i / 4);
    pixel[0] = red;
    pixel[1] = green;
    pixel[2] = blue;
    pixel[3] = 200;
  }
  return image;
}

TEST(SkinTone, LeavesSkinColorsAlone) {
  for (const Image& skin : {plain(194, 150, 130), plain(115, 82, 68), plain(60, 42, 35)}) {
    Image toned = skin;
    tone_skin(toned);
    EXPECT_EQ(toned.rgba, skin.rgba);
  }
}

TEST(SkinTone, MakesRedSkinNoRedderThanPeopleAre) {
  Image skin = plain(103, 45, 26);
  tone_skin(skin);
  const std::uint8_t* pixel = skin.pixel(1, 1);
  EXPECT_EQ(pixel[0], 103);
  EXPECT_NEAR(static_cast<double>(pixel[0]) / pixel[1], 1.08 * 115 / 82, 0.03);
  EXPECT_NEAR(static_cast<double>(pixel[1]) / pixel[2], 1.08 * 82 / 68, 0.03);
  EXPECT_EQ(pixel[3], 200);
}

TEST(SkinTone, LightSkinMayBeLessRed) {
  Image skin = plain(200, 130, 100);
  tone_skin(skin);
  EXPECT_NEAR(200.0 / skin.pixel(0, 0)[1], 1.08 * 194 / 150, 0.03);
}

TEST(SkinTone, KeepsBrightSpotsInRange) {
  Image skin = plain(103, 45, 26);
  skin.pixel(0, 0)[1] = 250;
  tone_skin(skin);
  EXPECT_EQ(skin.pixel(0, 0)[1], 255);
}

}  // namespace
}  // namespace throng::skinning
