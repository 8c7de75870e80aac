// A model of an image sensor: exposure, white balance, vignetting, noise. It changes only colors.
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "render/frame/frame.h"
#include "spec/camera/camera_spec.h"

namespace throng::render {

/// Gains of red, green (1) and blue, in linear sRGB, of a camera that is balanced for this
/// temperature in light of 6500 K: white points on the Planckian locus by Kim et al. (2002, US
/// patent 7024034, cubic splines). Valid from 1667 K to 25000 K.
Eigen::Vector3d white_balance_gains(double temperature_k);

/// Applies the sensor to the frame's colors, in linear light; without an ISO speed there is no
/// noise. Shot noise (whose variance is the light in electrons) and read noise are independent in
/// all pixels and channels and depend only on `seed`.
void apply_sensor(const camera::Sensor& sensor, std::uint64_t seed, Frame& frame);

}  // namespace throng::render
