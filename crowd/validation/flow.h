// How fast people walk in a crowd, and how many pass through a door: what pedestrian models are
// compared by.
#pragma once

#include <string>
#include <vector>

#include "crowd/validation/scene.h"

namespace throng::validation {

/// Mean speed in m/s at a density (1/m^2) by Weidmann (1993, Schriftenreihe des IVT 90), with
/// Kladek's formula; 0 from 5.4 /m^2 on.
double weidmann_speed_mps(double density);

struct DensitySpeed {
  double density = 0;  ///< 1/m^2
  double speed_mps = 0;
};

/// A corridor without an end.
struct Ring {
  double radius_m = 12.5;  ///< mean
  double width_m = 3;
  std::size_t people = 100;
  Sampled speed = Group{}.speed;
};
Scene ring(const Ring& spec);
/// The mean speed along a ring around the origin between two times.
double mean_ring_speed(crowd::Simulation& crowd, double from_s, double until_s);

/// People who walk around in a ring of 3 m width and 12.5 m mean radius without an end, at one
/// density: their mean speed along it from 20 to 50 s.
DensitySpeed walk_in_ring(const Tested& tested, double density, std::uint64_t seed);

/// A room of 10 m x 10 m with a door in the middle of a wall of this thickness.
struct Bottleneck {
  double width_m = 1;
  double wall_m = 0.2;
  std::size_t people = 150;
};

Scene room_with_door(const Bottleneck& door);

/// People per second between the 10th and the 80th percentile of the passages of so many people at
/// these times, in order; 0 when they do not get so far.
double central_rate(const std::vector<double>& times_s, std::size_t people);

/// People per meter and second between the 10th and the 80th percentile of the passages, as
/// measured in experiments; 0 when they do not get so far within 300 s.
double specific_flow(const Tested& tested, const Bottleneck& bottleneck, std::uint64_t seed);

}  // namespace throng::validation
