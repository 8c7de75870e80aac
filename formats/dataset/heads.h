// Heads of an image as formats with head boxes have them.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "formats/dataset/dataset.h"

namespace throng::formats {

/// The head of somebody who passes the filters.
struct Head {
  const Person* person = nullptr;  ///< of the image
  Eigen::Vector2d place = Eigen::Vector2d::Zero();
  Box box;
  double visibility = 0;  ///< of what the person has in the box; of the person if that is nothing
};

/// Whether a place in box coordinates is in the image.
bool is_in_image(const Image& image, const Eigen::Vector2d& place);

/// Heads whose middles are in the image, as density maps and other formats of points count them,
/// but for those that the camera sees nothing of (`head_box` is null). They refer to people of the
/// image. Throws InputError where a record has no `head_box`.
std::vector<Head> heads_with_boxes(const Image& image);

}  // namespace throng::formats
