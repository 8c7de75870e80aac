#include "render/scenery/metering.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "base/compute/srgb.h"
#include "base/geometry/angle.h"

namespace throng::render {

namespace {

// Also in shaders/light.glsl.
constexpr double kWhite = 2.2;

/// As in shaders/light.glsl, where the source stands.
double film_response(double radiance, double black) {
  const double x = std::max(radiance - black, 0.0);
  return x * (6.2 * x + 0.6) / (x * (6.2 * x + 1.7) + 0.06);
}

/// The radiance that the film shows as each byte.
std::array<double, 256> radiances(double black) {
  std::array<double, 256> table{};
  for (std::size_t byte = 0; byte < table.size(); ++byte) {
    double low = 0;
    double high = kWhite;
    constexpr int kHalvings = 30;
    for (int i = 0; i < kHalvings; ++i) {
      const double middle = 0.5 * (low + high);
      (film(middle, black) * 255 < static_cast<double>(byte) ? low : high) = middle;
    }
    table[byte] = 0.5 * (low + high);
  }
  return table;
}

/// L of the film's image of a radiance.
double film_lightness(double radiance, double black) {
  const double luminance = linear_from_encoded(film(radiance, black));
  return luminance > 0.008856 ? 116 * std::cbrt(luminance) - 16 : 903.3 * luminance;
}

/// Pixels by the octaves of their radiance, which is all that the lightness depends on.
class Histogram {
 public:
  Histogram(std::span<const std::uint8_t> rgb, double black) : black_(black) {
    const std::array<double, 256> shown = radiances(black);
    for (std::size_t i = 0; i + 2 < rgb.size(); i += 3) {
      const double radiance =
          0.2126 * shown[rgb[i]] + 0.7152 * shown[rgb[i + 1]] + 0.0722 * shown[rgb[i + 2]];
      add(kPerOctave * std::log2(std::max(radiance, kDarkest) / kDarkest));
    }
  }

  /// Mean L with all light multiplied by a gain.
  double lightness(double gain) const {
    double sum = 0;
    for (std::size_t i = 0; i < bins_.size(); ++i) {
      if (bins_[i] == 0) continue;
      const double octave = (static_cast<double>(i) + 0.5) / kPerOctave;
      sum += bins_[i] * film_lightness(gain * kDarkest * std::exp2(octave), black_);
    }
    return sum / pixels_;
  }

  bool empty() const { return pixels_ == 0; }

 private:
  /// Shares a pixel between two bins, so that no gain jumps where a pixel's light changes a little:
  /// between images of a flight, or between devices that round otherwise.
  void add(double bin) {
    const double last = kBins - 1;
    const double at = std::clamp(bin - 0.5, 0.0, last);
    const auto lower = static_cast<std::size_t>(std::min(std::floor(at), last - 1));
    const double upper_share = at - static_cast<double>(lower);
    bins_.at(lower) += 1 - upper_share;
    bins_.at(lower + 1) += upper_share;
    ++pixels_;
  }

  static constexpr double kDarkest = 1.0 / 1024;
  static constexpr double kPerOctave = 8;
  static constexpr std::size_t kBins = 96;  // to 4 units of radiance

  std::array<double, kBins> bins_{};
  double pixels_ = 0;
  double black_;
};

}  // namespace

double film(double radiance, double black) {
  return std::min(film_response(radiance, black) / film_response(kWhite, black), 1.0);
}

camera::Camera metering_camera(const camera::Camera& camera) {
  constexpr int kWidth = 64;
  constexpr double kMaxHfovRad = 100 * kDegree;
  const camera::Intrinsics& lens = camera.intrinsics;
  const int height = std::clamp(
      static_cast<int>(std::lround(static_cast<double>(kWidth) * lens.height / lens.width)), 8,
      256);
  const double hfov = 2 * std::atan(0.5 * lens.width / lens.fx_px);
  return {camera::intrinsics_from_hfov(kWidth, height, std::min(hfov, kMaxHfovRad)), camera.pose};
}

double metered_lightness(double illuminance_lux) {
  constexpr double kNight = 28;
  constexpr double kDay = 65;
  constexpr double kDuskLux = 1000;
  constexpr double kDayLux = 20000;
  const double share = std::log(illuminance_lux / kDuskLux) / std::log(kDayLux / kDuskLux);
  return kNight + (kDay - kNight) * std::clamp(share, 0.0, 1.0);
}

double metering_gain(std::span<const std::uint8_t> rgb, double lightness, double film_black) {
  constexpr double kMaxGain = 8;
  constexpr double kCorrected = 0.75;  // share of the difference, in EV
  const Histogram histogram(rgb, film_black);
  if (histogram.empty()) return 1;
  double low = 1 / kMaxGain;
  double high = kMaxGain;
  constexpr int kHalvings = 12;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = std::sqrt(low * high);
    (histogram.lightness(middle) < lightness ? low : high) = middle;
  }
  return std::pow(std::sqrt(low * high), kCorrected);
}

double metered_iso(double illuminance_lux, double gain) {
  constexpr double kFNumber = 2.8;
  constexpr double kExposureS = 1.0 / 60;
  constexpr double kConstant = 250;  // lux seconds
  constexpr double kVisible = 400;
  constexpr double kMaxIso = 1600;
  const double iso = kConstant * kFNumber * kFNumber / (kExposureS * illuminance_lux) * gain;
  return iso < kVisible ? 0 : std::min(iso, kMaxIso);
}

}  // namespace throng::render
