#include "formats/dataset/raster_files.h"

#include <fmt/format.h>

#include <limits>

#include "base/error.h"

namespace throng::formats {

namespace fs = std::filesystem;

namespace {

/// Reads a raster of 8 bits per sample.
images::Raster read_image(const fs::path& path, int channels, int width, int height) {
  images::Raster raster = images::read_raster(path);
  if (raster.bits != 8 || raster.channels != channels || raster.width != width ||
      raster.height != height) {
    throw InputError(
        {path.string(), "",
         fmt::format("{} x {}, {} channels of {} bits", raster.width, raster.height,
                     raster.channels, raster.bits),
         fmt::format("{} x {}, 8-bit {}", width, height, channels == 1 ? "gray" : "RGB")});
  }
  return raster;
}

}  // namespace

std::vector<std::uint32_t> read_instances(const fs::path& path, int width, int height) {
  const images::Raster raster = read_image(path, 3, width, height);
  std::vector<std::uint32_t> ids(raster.samples.size() / 3);
  for (std::size_t i = 0; i < ids.size(); ++i) {
    const std::uint16_t* rgb = raster.samples.data() + 3 * i;
    ids[i] = static_cast<std::uint32_t>(rgb[0]) | static_cast<std::uint32_t>(rgb[1]) << 8 |
             static_cast<std::uint32_t>(rgb[2]) << 16;
  }
  return ids;
}

std::vector<world::SemanticClass> read_classes(const fs::path& path, int width, int height) {
  const images::Raster raster = read_image(path, 1, width, height);
  std::vector<world::SemanticClass> classes;
  classes.reserve(raster.samples.size());
  for (const std::uint16_t value : raster.samples) {
    if (value >= world::kSemanticClasses) {
      throw InputError({path.string(), "", fmt::format("class {}", value),
                        fmt::format("0 to {}", world::kSemanticClasses - 1)});
    }
    classes.push_back(static_cast<world::SemanticClass>(value));
  }
  return classes;
}

fs::path raster_path(const fs::path& root, const char* kind, const std::string& image_file) {
  const std::size_t slash = image_file.find('/');
  const std::string rest = slash == std::string::npos ? image_file : image_file.substr(slash + 1);
  return (root / kind / rest).replace_extension(".png");
}

std::optional<Eigen::Vector2d> decode_flow(const std::uint16_t* sample) {
  constexpr double kPerPixel = 64;
  constexpr double kZero = 32768;
  if (sample[2] == 0) return std::nullopt;
  return Eigen::Vector2d(sample[0] - kZero, sample[1] - kZero) / kPerPixel;
}

std::vector<float> depth_meters(const images::Raster& depth) {
  constexpr float kMetersPerUnit = 0.01F;
  std::vector<float> meters;
  meters.reserve(depth.samples.size());
  for (const std::uint16_t sample : depth.samples) {
    meters.push_back(sample == 0 ? std::numeric_limits<float>::infinity()
                                 : kMetersPerUnit * static_cast<float>(sample));
  }
  return meters;
}

}  // namespace throng::formats
