// How calmly people move and stand: turns of their headings, and overlaps of their bodies.
#pragma once

#include <cstdint>

#include "validation/scene.h"

namespace throng::validation {

/// Scenes in which people are watched.
enum class WatchedScene : std::uint8_t {
  queue,          ///< 150 people before a door of 0.8 m, from 20 to 60 s
  open_square,    ///< 1 person/m^2 walks to random points, from 20 to 60 s
  sparse_square,  ///< the same with 0.5 people/m^2
  counter_flow    ///< 100 people against 100 through a corridor 2 m wide, from 20 to 60 s
};

struct CalmRun {
  /// Turns of the heading by more than 90° from the preferred direction, per person and minute;
  /// those within 3 s of another goal do not count.
  double turns = 0;
  /// Root mean square of the turning rate of people slower than 0.2 m/s, in °/s; 0 without any.
  double slow_yaw_rate_deg_s = 0;
  double overlap_m = 0;  ///< deepest overlap of two bodies from the first step on
};

CalmRun watch(const Tested& tested, WatchedScene scene, std::uint64_t seed);

}  // namespace throng::validation
