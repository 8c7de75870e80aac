// The sky's light by direction, as it falls on a place: clear skies by Preetham, Shirley and Smits
// (1999), whose luminance is Perez's, closed covers by the CIE's overcast sky (Moon and Spencer
// 1942).
#pragma once

#include <Eigen/Core>
#include <vector>

#include "render/scenery/daylight.h"
#include "spec/render/environment.h"

namespace throng::render {

/// The radiance of the sky in units of daylight.h before exposure, scaled so that level ground
/// under open sky receives Daylight::sky.
class SkyLight {
 public:
  SkyLight(const Environment& environment, const Daylight& day);

  /// Linear RGB from a direction (unit vector); of the horizon for directions below it.
  const Eigen::Array3f& radiance(const Eigen::Vector3f& direction) const;

 private:
  std::vector<Eigen::Array3f> table_;  ///< by rows of equal sine of the elevation
};

}  // namespace throng::render
