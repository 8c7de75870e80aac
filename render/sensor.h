// What a sensor and its electronics make of a picture: exposure, white balance, vignetting, noise.
// Only colours change.
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "camera/camera.h"
#include "render/frame.h"

namespace throng::render {

struct Sensor {
  double ev = 0;  ///< exposure compensation: light is doubled by each 1
  /// Colour temperature (K) that the camera takes for white; daylight is 6500. Lower makes pictures
  /// bluer, higher yellower.
  double white_balance_k = 6500;
  double vignette = 0;  ///< share of the natural fall of light, cos^4 of the angle from the axis
  double iso = 0;       ///< 0: no noise
  /// Electrons that fill a pixel at ISO 100; at others, full_well * 100 / iso make white.
  double full_well_e = 15000;
  double read_noise_e = 3;  ///< standard deviation, in electrons, of each reading

  bool is_neutral() const {
    return ev == 0 && white_balance_k == 6500 && vignette == 0 && iso == 0;
  }
};

/// Gains of red, green and blue (green's is 1) of a camera that takes this temperature for white
/// when the light is of 6500 K: white points on the Planckian locus by Kim et al. (2002, US patent
/// 7024034, cubic splines), in linear sRGB. From 1667 K to 25000 K.
Eigen::Vector3d white_balance_gains(double temperature_k);

/// Changes the frame's colours, in linear light. The noise, of photons (its variance is the light
/// in electrons) and of reading, is independent in all pixels and channels and a function of `seed`
/// only.
void apply_sensor(const Sensor& sensor, std::uint64_t seed, Frame& frame);

}  // namespace throng::render
