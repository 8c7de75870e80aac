// Heads of the people in an image, for formats with head boxes.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "formats/dataset/dataset.h"

namespace throng::formats {

/// The head of a person who passes the filters.
struct Head {
  const Person* person = nullptr;                   ///< points into Image::people
  Eigen::Vector2d place = Eigen::Vector2d::Zero();  ///< center, box coordinates
  Box box;
  double visibility = 0;  ///< of the person's pixels in the box; of the person if there are none
};

/// Whether a point in box coordinates is in the image.
bool is_in_image(const Image& image, const Eigen::Vector2d& place);

/// Heads with centers in the image, as counted by density maps and point formats, except for those
/// of whose surface the camera sees nothing (`head_box` is null). The image must outlive the
/// result. Throws InputError if a record has no `head_box`.
std::vector<Head> heads_with_boxes(const Image& image);

}  // namespace throng::formats
