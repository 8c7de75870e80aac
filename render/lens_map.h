// Where the pixels of a lens that distorts lie in a wider pinhole picture.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "camera/camera.h"
#include "render/person_geometry.h"
#include "render/pixel_weights.h"

namespace throng::render {

/// Which pinhole picture a distorted image comes from, and where in it each pixel lies.
struct LensMap {
  camera::Intrinsics wide;      ///< the smallest that covers the image as finely everywhere
  std::vector<float> position;  ///< x, y in the wide picture (OpenCV's pixels) of each image pixel
  PixelWeights weights;         ///< how many pixels of the image come from each wide one
};

/// Rows of the image of a camera with distortion. The model must hold in the whole image: check().
/// The weights also count pixels around the image, up to a quarter of its size away.
LensMap lens_map(const camera::Intrinsics& lens, const Rows& rows);

/// Size of the wide picture that such a camera's images need: the image's own for a pinhole, 0 if
/// the lens's model does not hold somewhere in the image.
Eigen::Vector2i wide_size(const camera::Intrinsics& lens);

}  // namespace throng::render
