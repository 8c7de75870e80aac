#include "render/lens/sensor.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "base/compute/parallel.h"
#include "base/compute/random.h"
#include "base/compute/srgb.h"
#include "base/error.h"

namespace throng::render {

namespace {

constexpr std::size_t kChannels = 3;
constexpr std::size_t kNoiseGrain = 16;
constexpr double kDaylightK = 6500;
constexpr double kBaseIso = 100;

/// Standard normal values at the middles of equal shares of probability: a normal number is one of
/// them at random. The table's variance is 1 to 1e-4.
class NormalTable {
 public:
  static constexpr int kBits = 16;

  NormalTable() : values_(std::size_t{1} << kBits) {
    for (std::size_t i = 0; i < values_.size(); ++i) {
      values_[i] = static_cast<float>(
          quantile((static_cast<double>(i) + 0.5) / static_cast<double>(values_.size())));
    }
  }

  float operator[](std::uint32_t index) const { return values_[index]; }

 private:
  /// The inverse of the normal distribution function, by bisection: it is made once.
  static double quantile(double share) {
    double low = -6;
    double high = 6;
    constexpr int kHalvings = 40;
    for (int i = 0; i < kHalvings; ++i) {
      const double middle = 0.5 * (low + high);
      (0.5 * std::erfc(-middle / std::numbers::sqrt2) < share ? low : high) = middle;
    }
    return 0.5 * (low + high);
  }

  std::vector<float> values_;
};

const NormalTable& normal_table() {
  static const NormalTable table;
  return table;
}

/// Normal numbers, two from each 32 random bits.
class Noise {
 public:
  Noise(std::uint64_t seed, std::uint64_t row)
      : random_(seed, Stream::camera_noise, row), table_(&normal_table()) {}

  float next() {
    if (!half_) bits_ = random_.bits();
    half_ = !half_;
    return (*table_)[half_ ? bits_ & 0xFFFFU : bits_ >> NormalTable::kBits];
  }

 private:
  Random random_;
  const NormalTable* table_;
  std::uint32_t bits_ = 0;
  bool half_ = false;
};

/// x, y of CIE 1931 of a black body.
Eigen::Vector2d planckian_xy(double temperature_k) {
  const double t = 1000 / temperature_k;
  const double x = temperature_k < 4000
                       ? ((-0.2661239 * t - 0.2343589) * t + 0.8776956) * t + 0.179910
                       : ((-3.0258469 * t + 2.1070379) * t + 0.2226347) * t + 0.240390;
  if (temperature_k < 2222) {
    return {x, ((-1.1063814 * x - 1.34811020) * x + 2.18555832) * x - 0.20219683};
  }
  if (temperature_k < 4000) {
    return {x, ((-0.9549476 * x - 1.37418593) * x + 2.09137015) * x - 0.16748867};
  }
  return {x, ((3.0817580 * x - 5.87338670) * x + 3.75112997) * x - 0.37001483};
}

/// Linear sRGB of white light of this temperature, of luminance 1.
Eigen::Vector3d white(double temperature_k) {
  const Eigen::Vector2d xy = planckian_xy(temperature_k);
  const Eigen::Vector3d xyz(xy.x() / xy.y(), 1, (1 - xy.x() - xy.y()) / xy.y());
  Eigen::Matrix3d rgb_of_xyz;
  rgb_of_xyz << 3.2406, -1.5372, -0.4986, -0.9689, 1.8758, 0.0415, 0.0557, -0.2040, 1.0570;
  // Below some 1900 K, blue is outside of what sRGB shows.
  constexpr double kMinGain = 0.02;
  return (rgb_of_xyz * xyz).cwiseMax(kMinGain);
}

/// Shares of light that fall on each pixel of a row.
void fall_off(const camera::Intrinsics& lens, double share, int row, std::vector<float>& light) {
  for (int x = 0; x < lens.width; ++x) {
    const Eigen::Vector2d direction = lens.direction_of({x, row}).value_or(Eigen::Vector2d::Zero());
    const double cos2 = 1 / (1 + direction.squaredNorm());
    light[static_cast<std::size_t>(x)] = static_cast<float>(1 - share + share * cos2 * cos2);
  }
}

/// Shares of red and blue that are left of each pixel of a row.
void shade_colors(const camera::Intrinsics& lens, double lost, int row, std::vector<float>& left) {
  const Eigen::Vector2d middle(0.5 * (lens.width - 1), 0.5 * (lens.height - 1));
  for (int x = 0; x < lens.width; ++x) {
    const double off = (Eigen::Vector2d(x, row) - middle).squaredNorm() / middle.squaredNorm();
    left[static_cast<std::size_t>(x)] = static_cast<float>(1 - lost * off);
  }
}

}  // namespace

Eigen::Vector3d white_balance_gains(double temperature_k) {
  check(temperature_k >= 1667 && temperature_k <= 25000, "white points are known for this");
  const Eigen::Vector3d gains = white(kDaylightK).cwiseQuotient(white(temperature_k));
  return gains / gains.y();
}

void apply_sensor(const camera::Sensor& sensor, std::uint64_t seed, Frame& frame) {
  if (sensor.is_neutral()) return;
  const Eigen::Vector3f gains =
      (white_balance_gains(sensor.white_balance_k) * std::exp2(sensor.ev)).cast<float>();
  const double iso = sensor.iso.value_or(0);
  const auto electrons =
      static_cast<float>(iso > 0 ? sensor.full_well_e * kBaseIso / iso : sensor.full_well_e);
  const auto read_variance = static_cast<float>(sensor.read_noise_e * sensor.read_noise_e);
  const auto width = static_cast<std::size_t>(frame.width());
  const auto rows = static_cast<std::size_t>(frame.height());
  parallel_ranges(rows, kNoiseGrain, [&](std::size_t begin, std::size_t end) {
    std::vector<float> light(width, 1.0F);
    std::vector<float> red_and_blue(width, 1.0F);
    for (std::size_t row = begin; row < end; ++row) {
      if (sensor.vignette > 0) {
        fall_off(frame.camera.intrinsics, sensor.vignette, static_cast<int>(row), light);
      }
      if (sensor.color_shading > 0) {
        shade_colors(frame.camera.intrinsics, sensor.color_shading, static_cast<int>(row),
                     red_and_blue);
      }
      Noise noise(seed, row);
      std::uint8_t* bytes = &frame.rgb[row * width * kChannels];
      for (std::size_t i = 0; i < width * kChannels; ++i) {
        const auto channel = static_cast<Eigen::Index>(i % kChannels);
        float value = linear_from_srgb(bytes[i]) * gains[channel] * light[i / kChannels];
        if (channel != 1) value *= red_and_blue[i / kChannels];
        if (iso > 0) {
          const float counted = value * electrons;
          value += noise.next() * std::sqrt(counted + read_variance) / electrons;
        }
        bytes[i] = srgb_from_linear(value);
      }
    }
  });
}

}  // namespace throng::render
