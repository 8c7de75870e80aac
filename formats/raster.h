// The dataset's values per pixel, read back from its PNG files as they are.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace throng::formats {

/// Samples row by row from the top, channels interleaved; 8-bit ones are widened.
struct Raster {
  int width = 0;
  int height = 0;
  int channels = 0;  ///< 1 (gray) or 3 (RGB)
  int bits = 0;      ///< 8 or 16
  std::vector<std::uint16_t> samples;
};

/// Throws InputError when the file is not there or is no gray or RGB PNG of 8 or 16 bits.
Raster read_raster(const std::filesystem::path& path);

/// One number per pixel of an image of instances: red + 256 * green + 65536 * blue. Throws like
/// read_raster(), and when the image is not of 8-bit RGB.
std::vector<std::uint32_t> read_instances(const std::filesystem::path& path);

/// Path of the values of this kind of an image: "images/a/b.jpg" and "depth" give
/// "depth/a/b.png".
std::filesystem::path raster_path(const std::filesystem::path& root, const char* kind,
                                  const std::string& image_file);

}  // namespace throng::formats
