// The position of the sun.
#pragma once

namespace throng::jobs {

/// The place and the day of jobs that name none: mid-August in southern Europe.
inline constexpr double kUsualLatitudeDeg = 45;
inline constexpr int kUsualDayOfYear = 225;

/// The sun's direction.
struct Sun {
  double azimuth_rad = 0;    ///< counter-clockwise from +x (east); +y is north
  double elevation_rad = 0;  ///< negative below the horizon
};

/// Position of the sun at a solar time (hours from midnight): sin(elevation) = sin(lat) sin(dec) +
/// cos(lat) cos(dec) cos(hour angle). The declination is Spencer's Fourier series of the day of the
/// year (Spencer 1971, Search 2(5), p. 172; within 0.05 degrees).
Sun sun_at(double time_of_day_h, double latitude_deg, int day_of_year);

}  // namespace throng::jobs
