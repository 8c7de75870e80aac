// Values per pixel of one image of a dataset, read once for all checks.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/compute/srgb.h"
#include "checks/findings.h"
#include "formats/dataset/dataset.h"

namespace throng::checks {

/// Planes of values, row by row. A plane is empty if the dataset does not have it, or if its file
/// is damaged, which is a finding.
struct Pixels {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgb;              ///< the image, 3 per pixel
  std::vector<std::uint32_t> ids;             ///< instances
  std::vector<std::uint16_t> depth_cm;        ///< z in the camera frame; 0: sky
  std::vector<std::uint16_t> normals;         ///< 3 per pixel, as in the file
  std::vector<std::uint16_t> flow;            ///< 3 per pixel, as in the file
  std::vector<std::uint16_t> flow_backward;   ///< 3 per pixel, as in the file
  std::vector<std::uint16_t> flow_occlusion;  ///< as in the file
  std::vector<std::uint16_t> scene_flow;      ///< 3 per pixel, as in the file
  std::vector<std::uint16_t> hazard_opacity;  ///< 3 per pixel
  std::vector<std::uint16_t> parts;
  std::vector<std::uint16_t> semantic;  ///< world::SemanticClass

  std::size_t count() const {
    return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  }
  std::size_t at(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
           static_cast<std::size_t>(x);
  }
  bool holds(int x, int y, int margin = 0) const {
    return x >= margin && y >= margin && x < width - margin && y < height - margin;
  }
  double depth_m(std::size_t pixel) const { return depth_cm[pixel] / 100.0; }
  /// Brightness, 0 to 255 (ITU-R BT.601).
  double luma(std::size_t pixel) const {
    const std::uint8_t* c = &rgb[3 * pixel];
    return 0.299 * c[0] + 0.587 * c[1] + 0.114 * c[2];
  }
  /// In linear light, 0 to 1 (ITU-R BT.709).
  double luminance(std::size_t pixel) const {
    const std::uint8_t* c = &rgb[3 * pixel];
    return 0.2126 * linear_from_srgb(c[0]) + 0.7152 * linear_from_srgb(c[1]) +
           0.0722 * linear_from_srgb(c[2]);
  }
};

/// Reads the image and all rasters that the dataset has of it. Adds a finding for each file that is
/// missing, damaged or of another size or kind.
Pixels read_pixels(const formats::DatasetInfo& info, const formats::Image& image,
                   Findings& findings);

/// The path of an image's raster: "depth/run000/d1/000003.png".
std::string raster_name(const char* kind, const formats::Image& image);

}  // namespace throng::checks
