// Speeds of people in a crowd and flows through doors, by which pedestrian models are compared.
#pragma once

#include <string>
#include <vector>

#include "spec/crowd/experiment.h"
#include "validation/scene.h"

namespace throng::validation {

/// Mean speed (m/s) at a density (1/m^2) by Weidmann (1993, Schriftenreihe des IVT 90), in Kladek's
/// formula; 0 from 5.4 1/m^2 on.
double weidmann_speed_mps(double density);

/// A corridor in the form of a ring.
struct Ring {
  double radius_m = 12.5;  ///< mean radius
  double width_m = 3;
  std::size_t people = 100;
  Sampled speed = Group{}.speed;
};
/// Returns the scene of people who walk around in a ring.
TestScene ring(const Ring& spec);
/// Mean speed along a ring around the origin between two times (m/s).
double mean_ring_speed(crowd::Simulation& crowd, double from_s, double until_s);

/// Returns the mean speed from 20 to 50 s of people in a ring at a density (1/m^2), which sets
/// their number.
DensitySpeed walk_in_ring(const Tested& tested, double density, std::uint64_t seed,
                          Ring corridor = {});

/// A room with a door in the middle of a wall. The room is 10 m long, or longer where people would
/// stand closer than 2.5 per square meter.
struct Bottleneck {
  /// Width of the door.
  double width_m = 1;
  /// Thickness of the wall.
  double wall_m = 0.2;
  std::size_t people = 150;
  /// Width of the room; at least that of the door.
  double room_m = 10;
  /// How far the corners of the door are cut on the side of the room, along the wall (at most all
  /// of it) and along the passage (at most its length).
  double corner_cut_m = 0;
};

/// Doors of one width for 75 people, drawn with other corners, depths and rooms; a few if not
/// `all`.
std::vector<Bottleneck> drawn_doors(double width_m, bool all);

TestScene room_with_door(const Bottleneck& door);

/// Flow (1/s) between the 10th and the 80th percentile of the passages of `people`; `times_s` are
/// the sorted times of passage. Returns 0 if fewer people pass.
double central_rate(const std::vector<double>& times_s, std::size_t people);

/// Specific flow (1/(m s)) between the 10th and the 80th percentile of the passages, as in
/// experiments; 0 if fewer people pass within 300 s.
double specific_flow(const Tested& tested, const Bottleneck& bottleneck, std::uint64_t seed);

}  // namespace throng::validation
