// The dataset's values per pixel: where their files are, and ids of instances.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "base/graphics/images/raster.h"
#include "world/semantic_class.h"

namespace throng::formats {

/// One number per pixel of an image of this size, in a file of instances: red + 256 * green + 65536
/// * blue. Throws like images::read_raster(), and for another kind of PNG and another size.
std::vector<std::uint32_t> read_instances(const std::filesystem::path& path, int width, int height);

/// The class of each pixel of an image of this size, in a file of semantic/. Throws like
/// images::read_raster(), and for another kind of PNG, another size, and numbers that are no class.
std::vector<world::SemanticClass> read_classes(const std::filesystem::path& path, int width,
                                               int height);

/// Path of the values of this kind of an image: "images/a/b.jpg" and "depth" give
/// "depth/a/b.png".
std::filesystem::path raster_path(const std::filesystem::path& root, const char* kind,
                                  const std::string& image_file);

}  // namespace throng::formats
