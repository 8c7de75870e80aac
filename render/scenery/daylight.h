// The light of an environment: how strong and of which color sun, sky, lamps and air are, at every
// hour and in every weather.
//
// One unit of light is about 54 000 lux: the sun at its highest gives 1.85 of them. A surface's
// radiance is its albedo times the light that it receives.
#pragma once

#include <Eigen/Core>

#include "spec/render/environment.h"

namespace throng::render {

struct Daylight {
  /// Unit vector to what casts shadows: the sun, at least 3 degrees above the horizon so that
  /// shadows end, or the zenith, the brightest part of a gray sky.
  Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();
  Eigen::Array3d sun = Eigen::Array3d::Zero();     ///< on a white surface that faces it
  Eigen::Array3d sky = Eigen::Array3d::Zero();     ///< on a white surface under open sky
  Eigen::Array3d haze = Eigen::Array3d::Zero();    ///< color of far air and of the horizon
  Eigen::Array3d zenith = Eigen::Array3d::Zero();  ///< color of the sky above
  Eigen::Array3d lamps = Eigen::Array3d::Zero();   ///< where street lamps give one unit of light
  bool soft = false;  ///< shadows have no edges: the light comes from the whole sky
  bool dark = false;  ///< nothing casts shadows
  bool lamps_on = false;
  double extinction_per_m = 0;  ///< of the air
  double illuminance_lux = 0;   ///< on level ground in the open, lamps included
};

/// All of it as the film sees it: the exposure has adapted.
Daylight daylight(const Environment& environment);

}  // namespace throng::render
