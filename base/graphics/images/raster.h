// Gray and RGB PNG files, samples as they are in the file.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace throng::images {

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

}  // namespace throng::images
