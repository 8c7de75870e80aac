#include "render/lens/sensor.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/compute/srgb.h"

namespace throng::render {
namespace {

Frame gray(int width, int height, std::uint8_t value) {
  Frame frame;
  frame.camera.intrinsics = camera::intrinsics_from_hfov(width, height, 1.4);
  frame.rgb.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 3, value);
  return frame;
}

/// Mean and standard deviation of the linear light of a channel.
struct Light {
  double mean = 0;
  double sd = 0;
};

Light measure_light(const Frame& frame, std::size_t channel) {
  double sum = 0;
  double squares = 0;
  for (std::size_t i = channel; i < frame.rgb.size(); i += 3) {
    const double light = linear_from_srgb(frame.rgb[i]);
    sum += light;
    squares += light * light;
  }
  const double n = static_cast<double>(frame.rgb.size()) / 3;
  return {sum / n, std::sqrt(squares / n - sum * sum / n / n)};
}

TEST(Sensor, OffChangesNothing) {
  Frame frame = gray(32, 32, 93);
  apply_sensor({}, 1, frame);
  EXPECT_EQ(frame.rgb, gray(32, 32, 93).rgb);
}

TEST(Sensor, ExposureDoublesLight) {
  camera::Sensor sensor;
  sensor.ev = 1;
  Frame frame = gray(4, 4, 100);
  apply_sensor(sensor, 1, frame);
  EXPECT_NEAR(linear_from_srgb(frame.rgb[0]), 2 * linear_from_srgb(100), 0.004);
  sensor.ev = -1;
  apply_sensor(sensor, 1, frame);
  EXPECT_NEAR(frame.rgb[0], 100, 1);
}

TEST(Sensor, WhiteBalanceTintsImages) {
  EXPECT_TRUE(white_balance_gains(6500).isApprox(Eigen::Vector3d::Ones(), 1e-12));
  for (const double k : {1700.0, 2500.0, 3999.0, 4001.0, 5000.0}) {
    EXPECT_LT(white_balance_gains(k).x(), 1) << "a camera for warm light makes daylight blue";
    EXPECT_GT(white_balance_gains(k).z(), 1);
  }
  EXPECT_GT(white_balance_gains(9000).x(), 1);
  EXPECT_LT(white_balance_gains(9000).z(), 1);
  // The splines meet.
  EXPECT_TRUE(white_balance_gains(3999.9).isApprox(white_balance_gains(4000.1), 2e-3));
  // Incandescent light (2856 K, CIE A) in linear sRGB is about 1 : 0.45 : 0.10 against daylight's
  // white; worked out from x = 0.4476, y = 0.4074.
  const Eigen::Vector3d gains = white_balance_gains(2856);
  EXPECT_NEAR(gains.z() / gains.x(), 7.8, 1.5);
}

TEST(Sensor, CornersFallOffByTheFourthPowerOfTheCosine) {
  camera::Sensor sensor;
  sensor.vignette = 1;
  Frame frame = gray(401, 301, 200);
  apply_sensor(sensor, 1, frame);
  const double middle = linear_from_srgb(frame.rgb[(150 * 401 + 200) * 3]);
  const double edge = linear_from_srgb(frame.rgb[150 * 401 * 3]);
  EXPECT_NEAR(middle, linear_from_srgb(200), 0.005);
  const double angle = std::atan(200 / frame.camera.intrinsics.fx_px);
  EXPECT_NEAR(edge / middle, std::pow(std::cos(angle), 4), 0.01);
}

TEST(Sensor, NoiseIsThatOfPhotonsAndReading) {
  camera::Sensor sensor;
  for (const double iso : {100.0, 1600.0, 6400.0}) {
    sensor.iso = iso;
    const double white_e = sensor.full_well_e * 100 / iso;
    for (const std::uint8_t value : {90, 160, 200}) {
      Frame frame = gray(256, 256, value);
      apply_sensor(sensor, 5, frame);
      const double light = linear_from_srgb(value);
      // Rounding to bytes adds its own: that of a uniform distribution over a step.
      const double step = 0.5 * (linear_from_srgb(value + 1) - linear_from_srgb(value - 1));
      const double sd = std::sqrt((light * white_e + 9) / white_e / white_e + step * step / 12);
      for (std::size_t channel = 0; channel < 3; ++channel) {
        EXPECT_NEAR(measure_light(frame, channel).mean, light, 0.002);
        EXPECT_NEAR(measure_light(frame, channel).sd, sd, 0.02 * sd);
      }
    }
  }
}

TEST(Sensor, NoiseDependsOnItsSeedOnly) {
  camera::Sensor sensor;
  sensor.iso = 800;
  Frame a = gray(64, 64, 120);
  Frame b = a;
  Frame other = a;
  apply_sensor(sensor, 7, a);
  apply_sensor(sensor, 7, b);
  apply_sensor(sensor, 8, other);
  EXPECT_EQ(a.rgb, b.rgb);
  EXPECT_NE(a.rgb, other.rgb);
  // Neighbors, rows and channels have nothing to do with each other.
  double mean = 0;
  for (const std::uint8_t byte : a.rgb) mean += byte;
  mean /= static_cast<double>(a.rgb.size());
  for (const std::size_t lag : {std::size_t{1}, std::size_t{3}, std::size_t{64 * 3}}) {
    double together = 0;
    double alone = 0;
    for (std::size_t i = 0; i + lag < a.rgb.size(); ++i) {
      together += (a.rgb[i] - mean) * (a.rgb[i + lag] - mean);
      alone += (a.rgb[i] - mean) * (a.rgb[i] - mean);
    }
    EXPECT_LT(std::abs(together / alone), 0.04) << lag;
  }
}

}  // namespace
}  // namespace throng::render
