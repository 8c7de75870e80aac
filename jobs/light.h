// The sun over the scene, from the time of day.
#pragma once

#include "render/renderer.h"

namespace throng::jobs {

/// Where the sun stands at a solar time (hours from midnight), at 45 degrees north in mid-August
/// (declination 15 degrees); +x is east and +y is north. Standard solar position geometry:
/// sin(elevation) = sin(lat) sin(dec) + cos(lat) cos(dec) cos(hour angle).
render::Lighting sun_at(double time_of_day_h);

/// Whether the sun stands high enough (5 degrees) to light a scene.
bool sun_is_up(double time_of_day_h);

}  // namespace throng::jobs
