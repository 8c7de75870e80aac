// Hills drawn as an image.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "crowd/navigation/elevation.h"

namespace throng::crowd {

/// Heights at the centers of an image's pixels, interpolated in between; beside the image those of
/// its rim. The image's first row is its northern one (largest y).
class HeightField : public Elevation {
 public:
  /// Reads a <HeightField> file (.ht): the image (PNG), the pixels' size, the height of white, and
  /// the place of the image's corner of least x and y. Throws InputError, EnvironmentError.
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

/// The same, once per file.
std::shared_ptr<const HeightField> shared_height_field(const std::filesystem::path& path,
                                                       SharedParts& parts);

}  // namespace throng::crowd
