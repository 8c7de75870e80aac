// A camera's sensor: exposure compensation, white balance, vignetting, noise (render/lens/sensor.h
// applies them).
#pragma once

#include <optional>

namespace throng::camera {

struct Sensor {
  double ev = 0;  ///< exposure compensation: light is doubled by each 1
  /// Color temperature (K) that the camera takes for white; daylight is 6500. Lower makes images
  /// bluer, higher yellower.
  double white_balance_k = 6500;
  double vignette = 0;  ///< share of the natural fall of light, cos^4 of the angle from the axis
  std::optional<double> iso;  ///< 0: no noise; nothing: as the light asks for
  /// Each image's exposure follows its brightness; else only the hour's and weather's light.
  bool is_metered = true;
  /// Electrons that fill a pixel at ISO 100; at others, full_well * 100 / iso make white.
  double full_well_e = 15000;
  double read_noise_e = 3;  ///< standard deviation, in electrons, of each reading

  bool is_neutral() const {
    return ev == 0 && white_balance_k == 6500 && vignette == 0 && iso.value_or(0) == 0;
  }
};

}  // namespace throng::camera
