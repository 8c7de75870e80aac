// Light and weather of a run.
#pragma once

#include <Eigen/Core>
#include <cstdint>

namespace throng::render {

enum class Weather : std::uint8_t { clear, overcast, fog, rain };

/// Light and weather, as the renderer uses them.
struct Environment {
  double sun_azimuth_rad = 0.9;    ///< direction to the sun, counter-clockwise from +x
  double sun_elevation_rad = 0.8;  ///< above the horizon; negative: below it
  Weather weather = Weather::clear;
  /// Distance at which the air leaves 2 % of a contrast (the meteorological range).
  double visibility_m = 20000;
  double rain_mm_per_h = 0;  ///< rate of rain; ignored in other weather
  std::uint64_t seed = 1;    ///< determines lit windows, puddles and raindrops
  double smoke = 0;          ///< 0 to 1: density of the smoke that rises from every hazard
  /// Mean wind near the ground, in which smoke drifts; m/s, world axes.
  Eigen::Vector2d wind_mps = Eigen::Vector2d::Zero();
};

}  // namespace throng::render
