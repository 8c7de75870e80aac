// Light and weather over the scenario, as one run has them.
#pragma once

#include <cstdint>

namespace throng::render {

enum class Weather : std::uint8_t { clear, overcast, fog, rain };

struct Environment {
  double sun_azimuth_rad = 0.9;    ///< counter-clockwise from +x, where the sun stands
  double sun_elevation_rad = 0.8;  ///< above the horizon; negative: below it
  Weather weather = Weather::clear;
  /// Distance at which the air leaves 2 % of a contrast (the meteorological range).
  double visibility_m = 20000;
  double rain_mm_per_h = 0;  ///< only in rain
  std::uint64_t seed = 1;    ///< which windows are lit, where puddles lie and drops fall
  double smoke = 0;          ///< 0 to 1: how much of it rises from every danger
};

}  // namespace throng::render
