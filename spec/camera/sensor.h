// Properties of a camera's sensor: exposure compensation, white balance, vignetting, noise
// (render/lens/sensor.h applies them).
#pragma once

#include <optional>

namespace throng::camera {

struct Sensor {
  double ev = 0;  ///< exposure compensation (EV): +1 doubles the light
  /// Color temperature (K) that the camera renders as white; daylight has 6500. Lower values make
  /// images bluer, higher ones yellower.
  double white_balance_k = 6500;
  double vignette = 0;  ///< share of the natural falloff, cos^4 of the angle from the axis
  /// Share of red and blue that is lost in the corners; between, it grows as the squared distance
  /// from the middle.
  double color_shading = 0;
  std::optional<double> iso;  ///< 0: no noise; nothing: chosen by the light
  double min_iso = 0;         ///< least ISO that the camera chooses
  /// Whether each image's exposure follows its brightness; else it follows the light of the hour
  /// and the weather only.
  bool is_metered = true;
  /// Electrons that saturate a pixel at ISO 100; at another ISO, full_well_e * 100 / iso do.
  double full_well_e = 15000;
  double read_noise_e = 3;  ///< standard deviation of the read noise, in electrons

  bool is_neutral() const {
    return ev == 0 && white_balance_k == 6500 && vignette == 0 && color_shading == 0 &&
           iso.value_or(0) == 0;
  }
};

}  // namespace throng::camera
