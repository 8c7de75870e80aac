// Files of a dataset with values per pixel: paths, instances and semantic classes.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/graphics/images/raster.h"
#include "world/semantic_class.h"

namespace throng::formats {

/// Reads a file of instances of an image of this size: one number per pixel, red + 256 * green +
/// 65536 * blue. Throws as images::read_raster(), and for another kind of PNG or another size.
std::vector<std::uint32_t> read_instances(const std::filesystem::path& path, int width, int height);

/// Reads a file of semantic/ of an image of this size: one class per pixel. Throws as
/// images::read_raster(), and for another kind of PNG, another size and values that are no class.
std::vector<world::SemanticClass> read_classes(const std::filesystem::path& path, int width,
                                               int height);

/// The motion (px) in a sample of flow/ or flow_backward/; std::nullopt if it is unknown.
std::optional<Eigen::Vector2d> decode_flow(const std::uint16_t* sample);

/// Depth in meters of a raster of depth/; infinity where nothing is.
std::vector<float> depth_meters(const images::Raster& depth);

/// Path of an image's file of this kind: "images/a/b.jpg" and "depth" give "depth/a/b.png" below
/// `root`.
std::filesystem::path raster_path(const std::filesystem::path& root, const char* kind,
                                  const std::string& image_file);

}  // namespace throng::formats
