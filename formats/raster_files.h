// The dataset's values per pixel: where their files are, and ids of instances.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "images/raster.h"

namespace throng::formats {

/// One number per pixel of an image of instances: red + 256 * green + 65536 * blue. Throws like
/// images::read_raster(), and when the image is not of 8-bit RGB.
std::vector<std::uint32_t> read_instances(const std::filesystem::path& path);

/// Path of the values of this kind of an image: "images/a/b.jpg" and "depth" give
/// "depth/a/b.png".
std::filesystem::path raster_path(const std::filesystem::path& root, const char* kind,
                                  const std::string& image_file);

}  // namespace throng::formats
