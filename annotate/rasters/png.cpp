#include "annotate/rasters/png.h"

#include <isa-l/crc.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <span>
#include <string_view>
#include <vector>

#include "annotate/people/instance_id.h"
#include "base/error.h"
#include "base/files/deflate.h"

namespace throng::annotate {

namespace {

constexpr std::uint8_t kGray = 0;
constexpr std::uint8_t kRgb = 2;
constexpr std::uint8_t kFilterUp = 2;

void append_big_endian(std::string& text, std::uint32_t value) {
  for (const int shift : {24, 16, 8, 0}) text.push_back(static_cast<char>(value >> shift));
}

void append_chunk(std::string& png, std::string_view type, std::string_view data) {
  append_big_endian(png, static_cast<std::uint32_t>(data.size()));
  const std::size_t first = png.size();
  png += type;
  png += data;
  append_big_endian(png, crc32_gzip_refl(0, reinterpret_cast<const unsigned char*>(&png[first]),
                                         png.size() - first));
}

std::string header(const Raster& raster, int bits) {
  std::string data;
  append_big_endian(data, static_cast<std::uint32_t>(raster.width));
  append_big_endian(data, static_cast<std::uint32_t>(raster.height));
  data.push_back(static_cast<char>(bits));
  data.push_back(static_cast<char>(raster.channels == 3 ? kRgb : kGray));
  data.append(3, '\0');  // deflate, the usual filters, not interlaced
  return data;
}

/// Each row as its difference to the one above: neighboring rows of ground truth are nearly alike.
std::string encoded(const Raster& raster, int bits, const std::uint8_t* bytes) {
  thread_local std::vector<std::uint8_t> filtered;
  thread_local std::vector<std::uint8_t> compressed;
  const std::size_t row_bytes =
      static_cast<std::size_t>(raster.width) * raster.channels * (bits / 8);
  filtered.resize((row_bytes + 1) * raster.height);
  for (int y = 0; y < raster.height; ++y) {
    std::uint8_t* out = &filtered[(row_bytes + 1) * y];
    const std::uint8_t* row = bytes + row_bytes * y;
    *out++ = kFilterUp;
    if (y == 0) {
      std::copy_n(row, row_bytes, out);
      continue;
    }
    const std::uint8_t* above = row - row_bytes;
    for (std::size_t i = 0; i < row_bytes; ++i) {
      out[i] = static_cast<std::uint8_t>(row[i] - above[i]);
    }
  }
  std::string png = "\x89PNG\r\n\x1a\n";
  append_chunk(png, "IHDR", header(raster, bits));
  append_chunk(png, "IDAT", deflated(filtered, compressed));
  append_chunk(png, "IEND", "");
  return png;
}

std::size_t count_samples(const Raster& raster) {
  check(raster.width > 0 && raster.height > 0, "an image has pixels");
  check(raster.channels == 1 || raster.channels == 3, "an image is gray or RGB");
  return static_cast<std::size_t>(raster.width) * raster.height * raster.channels;
}

constexpr float kSignedZero = 32768;
constexpr float kMaxSample = 65535;

/// Whether a pixel's values are known and lie in [min, 65535].
bool fits(std::span<const float> values, float min) {
  // Unknown values are NaN: every comparison with them is false.
  return std::all_of(values.begin(), values.end(),
                     [&](float value) { return value >= min && value <= kMaxSample; });
}

std::string flow_png(const render::Frame& frame, const std::vector<float>& flow) {
  constexpr float kPerPixel = 64;
  std::vector<std::uint16_t> samples(flow.size() / 2 * 3);
  for (std::size_t i = 0; i * 2 < flow.size(); ++i) {
    const std::array values = {std::round(flow[i * 2] * kPerPixel + kSignedZero),
                               std::round(flow[i * 2 + 1] * kPerPixel + kSignedZero)};
    if (!fits(values, 0)) continue;
    samples[i * 3] = static_cast<std::uint16_t>(values[0]);
    samples[i * 3 + 1] = static_cast<std::uint16_t>(values[1]);
    samples[i * 3 + 2] = 1;
  }
  return png_bytes({frame.width(), frame.height(), 3}, samples);
}

}  // namespace

std::string png_bytes(const Raster& raster, std::span<const std::uint8_t> samples) {
  check(samples.size() == count_samples(raster), "an image has all its samples");
  return encoded(raster, 8, samples.data());
}

std::string png_bytes(const Raster& raster, std::span<const std::uint16_t> samples) {
  check(samples.size() == count_samples(raster), "an image has all its samples");
  static_assert(std::endian::native == std::endian::little);
  thread_local std::vector<std::uint16_t> swapped;
  swapped.resize(samples.size());
  std::transform(samples.begin(), samples.end(), swapped.begin(), [](std::uint16_t value) {
    return static_cast<std::uint16_t>((value << 8U) | (value >> 8U));
  });
  return encoded(raster, 16, reinterpret_cast<const std::uint8_t*>(swapped.data()));
}

std::string depth_png(const render::Frame& frame) {
  thread_local std::vector<std::uint16_t> centimeters;
  constexpr float kTooFar = 65536;
  centimeters.resize(frame.depth_m.size());
  std::transform(frame.depth_m.begin(), frame.depth_m.end(), centimeters.begin(), [](float depth) {
    // Surfaces that nearly touch the camera are not nothing.
    const float rounded = std::max(depth * kDepthPerMeter + 0.5F, 1.0F);
    return static_cast<std::uint16_t>(rounded < kTooFar ? static_cast<int>(rounded) : 0);
  });
  return png_bytes({frame.width(), frame.height(), 1}, centimeters);
}

std::string instance_png(const render::Frame& frame) {
  thread_local std::vector<std::uint8_t> rgb;
  rgb.resize(frame.id.size() * 3);
  std::uint8_t* out = rgb.data();
  for (const std::uint32_t id : frame.id) {
    const std::uint32_t instance = instance_of_id(id);
    out[0] = static_cast<std::uint8_t>(instance);
    out[1] = static_cast<std::uint8_t>(instance >> 8U);
    out[2] = static_cast<std::uint8_t>(instance >> 16U);
    out += 3;
  }
  return png_bytes({frame.width(), frame.height(), 3}, rgb);
}

std::string semantic_png(const render::Frame& frame) {
  return png_bytes({frame.width(), frame.height(), 1}, frame.surface);
}

std::string part_png(const render::Frame& frame) {
  return png_bytes({frame.width(), frame.height(), 1}, frame.part);
}

std::string normal_png(const render::Frame& frame) {
  return png_bytes({frame.width(), frame.height(), 3}, frame.normal);
}

std::string flow_png(const render::Frame& frame) { return flow_png(frame, frame.flow); }

std::string flow_backward_png(const render::Frame& frame) {
  return flow_png(frame, frame.flow_backward);
}

std::string flow_occlusion_png(const render::Frame& frame) {
  return png_bytes({frame.width(), frame.height(), 1}, frame.flow_target);
}

std::string hazard_opacity_png(const render::Frame& frame) {
  return png_bytes({frame.width(), frame.height(), 3}, frame.hazard_opacity);
}

std::string scene_flow_png(const render::Frame& frame) {
  constexpr float kPerMeter = 1000;
  std::vector<std::uint16_t> samples(frame.scene_flow_m.size());
  for (std::size_t i = 0; i < samples.size(); i += 3) {
    std::array<float, 3> values{};
    for (std::size_t c = 0; c < values.size(); ++c) {
      values.at(c) = std::round(frame.scene_flow_m[i + c] * kPerMeter + kSignedZero);
    }
    if (!fits(values, 1)) continue;  // 0 is what is unknown
    for (std::size_t c = 0; c < values.size(); ++c) {
      samples[i + c] = static_cast<std::uint16_t>(values.at(c));
    }
  }
  return png_bytes({frame.width(), frame.height(), 3}, samples);
}

}  // namespace throng::annotate
