#include "render/lens/processing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "base/compute/srgb.h"
#include "base/graphics/images/jpeg_file.h"
#include "base/graphics/images/jpeg_writer.h"

namespace throng::render {

namespace {

constexpr int kWhite16 = 65535;

cv::Mat wrap_rgb(Frame& frame) {
  return {frame.height(), frame.width(), CV_8UC3, frame.rgb.data()};
}

cv::Mat linear_light(const cv::Mat& rgb) {
  cv::Mat table(1, 256, CV_16UC1);
  for (int i = 0; i < table.cols; ++i) {
    table.at<std::uint16_t>(i) =
        cv::saturate_cast<std::uint16_t>(linear_from_srgb(static_cast<std::uint8_t>(i)) * kWhite16);
  }
  cv::Mat light;
  cv::LUT(rgb, table, light);
  return light;
}

void encode_light(const cv::Mat& light, cv::Mat& rgb) {
  static const std::vector<std::uint8_t> table = [] {
    std::vector<std::uint8_t> bytes(kWhite16 + 1);
    for (std::size_t i = 0; i < bytes.size(); ++i) {
      bytes[i] = srgb_from_linear(static_cast<float>(i) / kWhite16);
    }
    return bytes;
  }();
  rgb.forEach<cv::Vec3b>([&](cv::Vec3b& pixel, const int* at) {
    const auto& from = light.at<cv::Vec3w>(at[0], at[1]);
    for (int c = 0; c < 3; ++c) pixel[c] = table[from[c]];
  });
}

/// Light scattered over an eighth of the width, computed on a small image.
cv::Mat scattered(const cv::Mat& light) {
  constexpr int kSmaller = 16;
  const cv::Size small(std::max(1, light.cols / kSmaller), std::max(1, light.rows / kSmaller));
  cv::Mat wide;
  cv::resize(light, wide, small, 0, 0, cv::INTER_AREA);
  cv::GaussianBlur(wide, wide, {}, std::max(0.5, wide.cols / 8.0), 0, cv::BORDER_REPLICATE);
  cv::resize(wide, wide, light.size(), 0, 0, cv::INTER_LINEAR);
  return wide;
}

/// Standard deviation of the noise of middle gray, in encoded levels.
double noise_levels(const camera::Sensor& sensor) {
  const double iso = sensor.iso.value_or(0);
  if (iso <= 0) return 0;
  constexpr double kGray = 0.18;
  constexpr double kBaseIso = 100;
  constexpr double kLevelsPerLight = 255 * 1.195;  // slope of sRGB's curve at middle gray
  const double electrons = sensor.full_well_e * kBaseIso / iso;
  const double variance = kGray * electrons + sensor.read_noise_e * sensor.read_noise_e;
  return kLevelsPerLight * std::sqrt(variance) / electrons;
}

void denoise(double strength, double noise, std::array<cv::Mat, 3>& planes) {
  // Differences of texture that count as noise even where there is none, in encoded levels.
  constexpr double kTextureLevels = 12;
  constexpr double kNoises = 3;
  const double levels = strength * (kTextureLevels + kNoises * noise);
  cv::Mat smooth;
  cv::bilateralFilter(planes[0], smooth, /*d=*/7, levels, 1 + 2 * strength);
  planes[0] = smooth;
  for (std::size_t c = 1; c < planes.size(); ++c) {
    cv::GaussianBlur(planes.at(c), planes.at(c), {}, 2 * strength, 0, cv::BORDER_REPLICATE);
  }
}

/// Multiplies regions by gains of at most 2, towards the mean of the logarithm of their luma.
void map_tones(double strength, std::array<cv::Mat, 3>& planes) {
  constexpr int kSmaller = 8;
  constexpr double kDark = 8;  // levels
  const cv::Size size = planes[0].size();
  const cv::Size small(std::max(1, size.width / kSmaller), std::max(1, size.height / kSmaller));
  cv::Mat base;
  cv::resize(planes[0], base, small, 0, 0, cv::INTER_AREA);
  base.convertTo(base, CV_32F);
  base += kDark;
  cv::log(base, base);
  cv::GaussianBlur(base, base, {}, std::max(0.5, base.cols / 24.0), 0, cv::BORDER_REPLICATE);
  cv::Mat gain = (cv::mean(base)[0] - base) * (strength / 2);
  cv::min(cv::max(gain, -std::log(2.0)), std::log(2.0), gain);
  cv::exp(gain, gain);
  cv::resize(gain, gain, size, 0, 0, cv::INTER_LINEAR);
  constexpr double kNoChroma = 128;
  for (std::size_t c = 0; c < planes.size(); ++c) {
    const double zero = c == 0 ? 0 : kNoChroma;
    cv::Mat values;
    planes.at(c).convertTo(values, CV_32F, 1, -zero);
    cv::multiply(values, gain, values);
    values.convertTo(planes.at(c), CV_8U, 1, zero);
  }
}

void sharpen(double gain, cv::Mat& luma) {
  cv::Mat smooth;
  cv::GaussianBlur(luma, smooth, {}, 1, 0, cv::BORDER_REPLICATE);
  cv::addWeighted(luma, 1 + gain, smooth, -gain, 0, luma);
}

/// Encodes and decodes at the largest quality whose file is small enough; at the lowest one if none
/// is.
void compress(double bits_per_px, Frame& frame) {
  const double max_bytes = bits_per_px * frame.width() * frame.height() / 8;
  const auto encoded = [&](int quality) {
    return images::jpeg_bytes(frame.rgb, frame.width(), frame.height(), quality);
  };
  int low = 1;
  int high = 95;
  while (low < high) {
    const int middle = (low + high + 1) / 2;
    if (static_cast<double>(encoded(middle).size()) <= max_bytes) {
      low = middle;
    } else {
      high = middle - 1;
    }
  }
  const std::string bytes = encoded(low);
  frame.rgb = images::JpegFile(bytes, "the camera's image").decode(TJPF_RGB, /*strict=*/true);
}

}  // namespace

void apply_optics(const camera::Processing& processing, Frame& frame) {
  if (processing.point_spread_px <= 0 && processing.flare <= 0) return;
  cv::Mat rgb = wrap_rgb(frame);
  cv::Mat light = linear_light(rgb);
  if (processing.point_spread_px > 0) {
    cv::GaussianBlur(light, light, {}, processing.point_spread_px, 0, cv::BORDER_REPLICATE);
  }
  if (processing.flare > 0) {
    const double half = processing.flare / 2;
    const cv::Scalar mean = cv::mean(light);
    cv::addWeighted(light, 1 - processing.flare, scattered(light), half, 0, light);
    light += mean * half;
  }
  encode_light(light, rgb);
}

void apply_processing(const camera::Processing& processing, const camera::Sensor& sensor,
                      Frame& frame) {
  if (processing.denoising > 0 || processing.tone_mapping > 0 || processing.sharpening > 0) {
    cv::Mat rgb = wrap_rgb(frame);
    cv::Mat converted;
    cv::cvtColor(rgb, converted, cv::COLOR_RGB2YCrCb);
    std::array<cv::Mat, 3> planes;
    cv::split(converted, planes.data());
    if (processing.denoising > 0) denoise(processing.denoising, noise_levels(sensor), planes);
    if (processing.tone_mapping > 0) map_tones(processing.tone_mapping, planes);
    if (processing.sharpening > 0) sharpen(processing.sharpening, planes[0]);
    cv::merge(planes.data(), planes.size(), converted);
    cv::cvtColor(converted, rgb, cv::COLOR_YCrCb2RGB);
  }
  if (processing.bits_per_px > 0) compress(processing.bits_per_px, frame);
}

}  // namespace throng::render
