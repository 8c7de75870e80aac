#include "render/lens/processing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>

#include "base/compute/random.h"
#include "base/compute/srgb.h"
#include "render/lens/exposure.h"
#include "render/lens/sensor.h"

namespace throng::render {
namespace {

constexpr int kSide = 128;

/// A gray frame whose pixels have the values of a function of column and row.
Frame gray_frame(const std::function<int(int, int)>& value) {
  Frame frame;
  frame.camera.intrinsics = camera::intrinsics_from_hfov(kSide, kSide, 1.4);
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      for (int c = 0; c < 3; ++c) frame.rgb.push_back(static_cast<std::uint8_t>(value(x, y)));
    }
  }
  return frame;
}

int green(const Frame& frame, int x, int y) {
  return frame.rgb[3 * static_cast<std::size_t>(y * kSide + x) + 1];
}

double light(const Frame& frame, int x, int y) {
  return linear_from_srgb(static_cast<std::uint8_t>(green(frame, x, y)));
}

double mean_light(const Frame& frame) {
  double sum = 0;
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) sum += light(frame, x, y);
  }
  return sum / (kSide * kSide);
}

Frame halves(int left, int right) {
  return gray_frame([=](int x, int /*y*/) { return x < kSide / 2 ? left : right; });
}

/// Standard deviation of the values of columns `begin` to `end`.
double deviation(const Frame& frame, int begin, int end) {
  double sum = 0;
  double squares = 0;
  const int n = (end - begin) * kSide;
  for (int y = 0; y < kSide; ++y) {
    for (int x = begin; x < end; ++x) {
      sum += green(frame, x, y);
      squares += green(frame, x, y) * green(frame, x, y);
    }
  }
  return std::sqrt(squares / n - sum * sum / n / n);
}

TEST(Processing, OffChangesNothing) {
  Frame frame = halves(40, 200);
  const auto before = frame.rgb;
  apply_optics({}, frame);
  apply_processing({}, {}, frame);
  EXPECT_EQ(frame.rgb, before);
}

TEST(Processing, APointSpreadsAsAGaussianOfLight) {
  for (const double sigma : {0.8, 1.5, 3.0}) {
    // A line: columns beside it have the light of a Gaussian, integrated over a pixel.
    Frame frame = gray_frame([](int x, int /*y*/) { return x == kSide / 2 ? 255 : 0; });
    apply_optics({.point_spread_px = sigma}, frame);
    for (int away = 0; away <= 3; ++away) {
      const double expected =
          std::exp(-away * away / (2 * sigma * sigma)) / (sigma * std::sqrt(2 * 3.14159265358979));
      EXPECT_NEAR(light(frame, kSide / 2 + away, 60), expected, 0.02) << sigma << " " << away;
    }
    EXPECT_NEAR(mean_light(frame), 1.0 / kSide, 0.1 / kSide);
  }
}

TEST(Processing, FlareScattersLightIntoTheDark) {
  Frame frame = halves(0, 230);
  const double before = mean_light(frame);
  apply_optics({.flare = 0.1}, frame);
  EXPECT_NEAR(mean_light(frame), before, 0.02 * before);
  EXPECT_NEAR(light(frame, 4, 60), 0.05 * before, 0.02 * before) << "the even half";
  EXPECT_GT(light(frame, kSide / 2 - 4, 60), 1.3 * light(frame, 4, 60)) << "more beside the light";
}

TEST(Processing, DenoisingSmoothsNoiseAndKeepsEdges) {
  camera::Sensor sensor;
  sensor.iso = 1600;
  Frame noisy = halves(60, 180);
  apply_sensor(sensor, 3, noisy);
  Frame frame = noisy;
  apply_processing({.denoising = 0.7}, sensor, frame);
  EXPECT_LT(deviation(frame, 8, 56), 0.5 * deviation(noisy, 8, 56));
  EXPECT_NEAR(green(frame, kSide / 2 - 3, 60), 60, 12);
  EXPECT_NEAR(green(frame, kSide / 2 + 2, 60), 180, 12);
}

TEST(Processing, DenoisingSmearsFineTexture) {
  const auto texture = [](int x, int y) { return 100 + 3 * ((x / 2 + y / 2) % 2); };
  Frame frame = gray_frame(texture);
  apply_processing({.denoising = 1}, {}, frame);
  EXPECT_LT(deviation(frame, 8, 120), 0.5 * deviation(gray_frame(texture), 8, 120));
}

TEST(Processing, ToneMappingBringsRegionsNearer) {
  Frame frame = halves(40, 200);
  apply_processing({.tone_mapping = 0.6}, {}, frame);
  EXPECT_GT(green(frame, 8, 60), 45);
  EXPECT_LT(green(frame, 120, 60), 180);
  Frame even = halves(90, 90);
  apply_processing({.tone_mapping = 0.6}, {}, even);
  EXPECT_NEAR(green(even, 8, 60), 90, 1) << "nothing to even out";
}

TEST(Processing, SharpeningDrawsHalosAlongEdges) {
  Frame frame = halves(80, 160);
  apply_processing({.sharpening = 1}, {}, frame);
  EXPECT_LT(green(frame, kSide / 2 - 1, 60), 70);
  EXPECT_GT(green(frame, kSide / 2, 60), 170);
  EXPECT_NEAR(green(frame, 8, 60), 80, 1);
}

/// Mean step between neighboring columns at borders of blocks, over that inside of blocks.
double blockiness(const Frame& frame) {
  double at_borders = 0;
  double inside = 0;
  for (int y = 0; y < kSide; ++y) {
    for (int x = 1; x < kSide; ++x) {
      const double step = std::abs(green(frame, x, y) - green(frame, x - 1, y));
      (x % 8 == 0 ? at_borders : inside) += step / (x % 8 == 0 ? 15 : 112);
    }
  }
  return at_borders / inside;
}

TEST(Processing, FewerBitsMakeBlocks) {
  Random random(5, Stream::camera_noise, 0);
  const Frame original = gray_frame(
      [&](int x, int y) { return 60 + x / 2 + y / 4 + static_cast<int>(random.bits() % 24U); });
  Frame many = original;
  Frame few = original;
  apply_processing({.bits_per_px = 24}, {}, many);
  apply_processing({.bits_per_px = 0.4}, {}, few);
  EXPECT_NEAR(blockiness(original), 1, 0.1);
  EXPECT_NEAR(blockiness(many), 1, 0.1);
  EXPECT_GT(blockiness(few), 2);
  const auto error = [&](const Frame& frame) {
    double sum = 0;
    for (std::size_t i = 0; i < frame.rgb.size(); ++i) {
      sum += std::abs(frame.rgb[i] - original.rgb[i]);
    }
    return sum / static_cast<double>(frame.rgb.size());
  };
  EXPECT_LT(error(many), 6) << "chroma of half the resolution, and quality 95";
  EXPECT_GT(error(few), 1.5 * error(many));
}

TEST(Processing, ColorShadingTurnsCornersGreen) {
  camera::Sensor sensor;
  sensor.color_shading = 0.2;
  Frame frame = halves(150, 150);
  apply_sensor(sensor, 1, frame);
  EXPECT_NEAR(green(frame, 0, 0), 150, 1);
  EXPECT_NEAR(linear_from_srgb(frame.rgb[0]), 0.8 * linear_from_srgb(150), 0.01);
  const std::size_t middle = 3 * static_cast<std::size_t>(kSide / 2 * kSide + kSide / 2);
  EXPECT_NEAR(frame.rgb[middle], 150, 1);
}

TEST(Processing, InterlacedFramesHaveTheOtherFieldsOddRows) {
  Frame frame = halves(50, 50);
  interlace(halves(200, 200), frame);
  for (int y = 0; y < kSide; ++y) EXPECT_EQ(green(frame, 7, y), y % 2 == 0 ? 50 : 200);
}

}  // namespace
}  // namespace throng::render
