// The spectators of a scenario's stands, their seats and their paths when they leave; and those who
// sit on props.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "sim/people/cheering.h"
#include "world/scenario.h"
#include "world/stand_departures.h"

namespace throng::sim {

/// A person on a seat.
struct Spectator {
  std::uint64_t key = 0;                            ///< of random numbers
  Eigen::Vector2f seat = Eigen::Vector2f::Zero();   ///< m
  Eigen::Vector2f ahead = Eigen::Vector2f::Zero();  ///< from there to where the person stands (m)
  float yaw_rad = 0;
  double place = 0;  ///< of the block among all blocks, 0 to 1
  double rises_s = std::numeric_limits<double>::infinity();  ///< to leave
  bool is_playing = false;                                   ///< in a band: never sits
  bool only_sits = false;                                    ///< on a prop
  std::int32_t group = -1;                                   ///< of those on props; -1: alone
  std::optional<world::WayDown> way;                         ///< of those who leave
};

/// Place and posture of a spectator.
struct SpectatorNow {
  Eigen::Vector2f position = Eigen::Vector2f::Zero();  ///< m
  float yaw_rad = 0;
  Posture posture = Posture::sitting;
};

/// The spectators of all stands, and the sitters.
struct Spectators {
  std::vector<Spectator> stay;
  std::vector<Spectator> leave;  ///< in the order of the stands and world::departures()
};

/// Takes seats for all spectators; after them come the scenario's sitters, of whom neighbors on a
/// prop are a group, numbered from 0. With `all_stay`, nobody leaves.
Spectators take_seats(const world::Scenario& scenario, std::uint64_t seed, bool all_stay);

/// A spectator at a time.
SpectatorNow spectator_at(const Spectator& person, const CheeringWaves& waves, double time_s);

}  // namespace throng::sim
