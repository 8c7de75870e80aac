// CIELAB (CIE 15:2004) of sRGB bytes, white D65.
#pragma once

#include <Eigen/Core>
#include <cstdint>

namespace throng::annotate {

/// L*, a*, b* of a pixel given as three bytes.
Eigen::Vector3f cielab_of_srgb(const std::uint8_t* rgb);

}  // namespace throng::annotate
