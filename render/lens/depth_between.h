// Depth between the pixel centers of a pinhole image.
#pragma once

#include <Eigen/Core>

#include "render/frame/frame.h"

namespace throng::render {

/// The camera's z (m) of the surface of pixel `near`, at the offset `off` (px, within half a pixel)
/// from its center. Since 1 / z of a plane is linear in the image, the result is exact if the pixel
/// and a neighbor in each direction show the same plane. Infinite for the sky.
float depth_between(const Frame& image, const Eigen::Vector2i& near, const Eigen::Vector2f& off);

}  // namespace throng::render
