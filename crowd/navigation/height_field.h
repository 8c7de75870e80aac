// Heights of the ground from an image.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "crowd/navigation/elevation.h"

namespace throng::crowd {

/// Heights at the centers of pixels, interpolated bilinearly; outside the image, the height of its
/// border. The first row of the image is the northern one (max y).
class HeightField : public Elevation {
 public:
  /// Reads a <HeightField> file (.ht): image (PNG), size of a pixel, height of white, and position
  /// of the corner with min x and y. Throws InputError, EnvironmentError.
  explicit HeightField(const std::filesystem::path& path);

  float height_m(const Eigen::Vector2f& point) const override;
  Eigen::Vector2f gradient(const Eigen::Vector2f& point) const override;

 private:
  float at(int column, int row) const;

  int columns_ = 0;
  int rows_ = 0;
  float pixel_m_ = 1;
  Eigen::Vector2f corner_;
  std::vector<float> heights_m_;  // row by row, from the south
};

/// Returns the height field of a file, which is read once.
std::shared_ptr<const HeightField> shared_height_field(const std::filesystem::path& path,
                                                       SharedParts& parts);

}  // namespace throng::crowd
