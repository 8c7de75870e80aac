// Model of an image sensor: exposure, white balance, vignetting, noise. Only colors change.
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "render/frame.h"
#include "spec/camera/camera_spec.h"

namespace throng::render {

/// Gains of red, green and blue (green's is 1) of a camera that takes this temperature for white
/// when the light is of 6500 K: white points on the Planckian locus by Kim et al. (2002, US patent
/// 7024034, cubic splines), in linear sRGB. From 1667 K to 25000 K.
Eigen::Vector3d white_balance_gains(double temperature_k);

/// Changes the frame's colors, in linear light; a sensor without an ISO speed has no noise. The
/// noise, of photons (its variance is the light in electrons) and of reading, is independent in all
/// pixels and channels and a function of `seed` only.
void apply_sensor(const camera::Sensor& sensor, std::uint64_t seed, Frame& frame);

}  // namespace throng::render
