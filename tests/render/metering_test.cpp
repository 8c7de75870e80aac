// Automatic exposure.
#include "render/scenery/metering.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/compute/srgb.h"
#include "tests/render/stage.h"

namespace throng::render {
namespace {

constexpr double kFilmBlack = 0.008;  // of clear days and nights

Environment environment_at(double elevation_deg, Weather weather = Weather::clear) {
  return {0.8, elevation_deg * kDegree, weather, 20000, 0, 1};
}

/// CIELAB's mean L.
double mean_lightness(const Frame& frame) {
  double sum = 0;
  for (std::size_t i = 0; i + 2 < frame.rgb.size(); i += 3) {
    const double y = 0.2126 * linear_from_srgb(frame.rgb[i]) +
                     0.7152 * linear_from_srgb(frame.rgb[i + 1]) +
                     0.0722 * linear_from_srgb(frame.rgb[i + 2]);
    sum += y > 216.0 / 24389 ? 116 * std::cbrt(y) - 16 : y * 24389 / 27;
  }
  return 3 * sum / static_cast<double>(frame.rgb.size());
}

/// As dark as windows: bright plaster would be white at a gain of 1, from which no gain follows.
world::Building dark_block() {
  world::Building building = block(-20, -10, -20, 20, 9);
  building.paint = world::Paint(0.06F, 0.06F, 0.06F);
  return building;
}

TEST(Metering, TheGainBringsAnImageToTheLightnessButForAQuarterOfTheDifference) {
  Stage stage(open_ground({dark_block()}), environment_at(45));
  const camera::Camera camera = camera_at({15, 0, 12}, 180, -35);
  const Frame image = stage.renderer().draw({}, camera);
  for (const double lightness : {35.0, 45.0, 60.0}) {
    const double gain = metering_gain(image.rgb, lightness, kFilmBlack);
    const Frame corrected =
        stage.renderer().draw({}, camera, nullptr, {.exposure_gain = std::pow(gain, 1 / 0.75)});
    EXPECT_NEAR(mean_lightness(corrected), lightness, 1.5);
    const Frame metered = stage.renderer().draw({}, camera, nullptr, {.exposure_gain = gain});
    const double before = std::abs(mean_lightness(image) - lightness);
    EXPECT_LT(std::abs(mean_lightness(metered) - lightness), 0.4 * before + 1);
  }
}

TEST(Metering, OfNothingOrBlackOrWhiteIsWithinTheCamerasRange) {
  EXPECT_EQ(metering_gain({}, 50, kFilmBlack), 1);
  const std::vector<std::uint8_t> black(300, 0);
  const std::vector<std::uint8_t> white(300, 255);
  EXPECT_LE(metering_gain(black, 50, kFilmBlack), 8);
  EXPECT_GT(metering_gain(black, 50, kFilmBlack), 4);
  EXPECT_LT(metering_gain(white, 50, kFilmBlack), 1);
  EXPECT_GE(metering_gain(white, 50, kFilmBlack), 0.125);
}

TEST(Metering, PeopleDoNotChangeIt) {
  Stage stage(open_ground(), environment_at(45));
  const camera::Camera camera = camera_at({-8, 0, 6}, 0, -35);
  Scene crowd;
  for (int i = 0; i < 20; ++i) crowd.people.push_back(stage.standing(0.5 * i - 5, 0, i));
  EXPECT_EQ(stage.renderer().metered_gain({}, camera),
            stage.renderer().metered_gain(crowd, camera));
}

TEST(Metering, DoesNotDependOnTheImagesBefore) {
  Stage stage(open_ground({dark_block()}), environment_at(45));
  const camera::Camera wall = camera_at({15, 0, 12}, 180, -35);
  const camera::Camera sky = camera_at({15, 0, 12}, 0, 40, 200, 300);
  const double first = stage.renderer().metered_gain({}, wall);
  const double other = stage.renderer().metered_gain({}, sky);
  EXPECT_LT(other, first) << "a bright sky closes the camera";
  (void)stage.renderer().draw({}, sky);
  EXPECT_EQ(stage.renderer().metered_gain({}, wall), first);
}

TEST(Metering, ALensSeesTheSameLight) {
  Stage stage(open_ground({dark_block()}), environment_at(45));
  camera::Camera camera = camera_at({15, 0, 12}, 180, -35);
  const double plain = stage.renderer().metered_gain({}, camera);
  camera.intrinsics.distortion =
      camera::Distortion(camera::Distortion::Model::brown_conrady, {-0.2, 0.05});
  EXPECT_EQ(stage.renderer().metered_gain({}, camera), plain);
}

TEST(Metering, NightImagesAreDarkerThanThoseOfDayAndNotBlack) {
  EXPECT_EQ(metered_lightness(80000), 65);
  EXPECT_EQ(metered_lightness(9), 28);
  EXPECT_GT(metered_lightness(5000), 35);
  EXPECT_LT(metered_lightness(5000), 50);
  for (const double elevation_deg : {60.0, 20.0, 2.0, -3.0, -20.0}) {
    Stage stage(open_ground({dark_block()}), environment_at(elevation_deg));
    const camera::Camera camera = camera_at({15, 0, 12}, 180, -35);
    const double gain = stage.renderer().metered_gain({}, camera);
    const Frame image = stage.renderer().draw({}, camera, nullptr, {.exposure_gain = gain});
    const double wanted = metered_lightness(stage.renderer().illuminance_lux());
    EXPECT_NEAR(mean_lightness(image), wanted, 12) << elevation_deg;
  }
}

TEST(Metering, NoiseComesWithTheDark) {
  EXPECT_EQ(metered_iso(80000, 1), 0);
  EXPECT_EQ(metered_iso(600, 1), 0);
  EXPECT_NEAR(metered_iso(100, 1), 250 * 2.8 * 2.8 * 60 / 100, 1e-6);
  EXPECT_NEAR(metered_iso(100, 0.5), 250 * 2.8 * 2.8 * 60 / 200, 1e-6);
  EXPECT_EQ(metered_iso(9, 1), 1600);
}

}  // namespace
}  // namespace throng::render
