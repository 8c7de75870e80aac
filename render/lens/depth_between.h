// Depth between the pixels of a pinhole's image.
#pragma once

#include <Eigen/Core>

#include "render/frame.h"

namespace throng::render {

/// The camera's z (m) of what pixel `near` shows, at `off` (px, within half a pixel) from its
/// middle: of a plane 1 / z changes evenly over the image, so that this is exact where the pixel
/// and one beside it in each direction show the same plane. Infinite for the sky.
float depth_between(const Frame& image, const Eigen::Vector2i& near, const Eigen::Vector2f& off);

}  // namespace throng::render
