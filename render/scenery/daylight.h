// The light of an environment: intensities and colors of sun, sky, lamps and air at every hour and
// in every weather.
//
// One unit of light is about 54 000 lux; the sun in the zenith has 1.85 units. A surface's radiance
// is its albedo times the light that it receives.
#pragma once

#include <Eigen/Core>

#include "spec/render/environment.h"

namespace throng::render {

/// Share of a closed cover's light that Daylight::sun holds.
inline constexpr double kSoftShare = 0.1;

/// The light of an environment; colors are linear RGB.
struct Daylight {
  /// Unit vector toward the light that casts shadows: the sun (at least 3 degrees above the
  /// horizon, so that shadows are finite), or the zenith, the brightest part of an overcast sky.
  Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();
  Eigen::Array3d sun = Eigen::Array3d::Zero();     ///< on a white surface facing the sun
  Eigen::Array3d sky = Eigen::Array3d::Zero();     ///< on a white surface under open sky
  Eigen::Array3d haze = Eigen::Array3d::Zero();    ///< color of distant air and the horizon
  Eigen::Array3d zenith = Eigen::Array3d::Zero();  ///< color of the sky in the zenith
  Eigen::Array3d lamps = Eigen::Array3d::Zero();   ///< color of one unit of lamp light
  bool soft = false;  ///< soft shadows: the light comes from the whole sky
  bool dark = false;  ///< no shadows
  bool lamps_on = false;
  /// Radiance that images show as black, over that of white. Cameras set it higher in flat light,
  /// whose images would otherwise have no dark parts.
  double film_black = 0.008;
  double exposure = 1;          ///< factor of the camera's adaptation in the colors above
  double extinction_per_m = 0;  ///< extinction coefficient of the air
  double illuminance_lux = 0;   ///< on horizontal ground under open sky, including lamps
};

/// The light of an environment, scaled by the camera's adaptation to it.
Daylight daylight(const Environment& environment);

}  // namespace throng::render
