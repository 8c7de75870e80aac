// Gray and RGB PNG files with unchanged samples.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace throng::images {

/// Samples of an image by rows from the top, with interleaved channels; 8-bit samples are stored in
/// 16 bits without scaling.
struct Raster {
  int width = 0;
  int height = 0;
  int channels = 0;  ///< 1 (gray) or 3 (RGB)
  int bits = 0;      ///< per sample in the file: 8 or 16
  std::vector<std::uint16_t> samples;
};

/// Reads a PNG file. Throws InputError if it does not exist or is not a gray or RGB PNG with 8 or
/// 16 bits.
Raster read_raster(const std::filesystem::path& path);

}  // namespace throng::images
