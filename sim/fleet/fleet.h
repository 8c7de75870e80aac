// The drones of a flight: their bodies, those who steer them, and the air around them.
#pragma once

#include <cstdint>
#include <deque>
#include <utility>
#include <vector>

#include "sim/fleet/pilot.h"
#include "sim/policies/planned_drone.h"
#include "sim/vehicle/damage.h"
#include "sim/vehicle/downwash.h"
#include "sim/vehicle/fall_warning.h"
#include "sim/vehicle/flight_world.h"
#include "sim/vehicle/near_misses.h"
#include "sim/vehicle/wind.h"

namespace throng::sim {

/// The wind of a flight.
struct FlightWeather {
  WindSpec wind;
  std::uint64_t seed = 1;  ///< seed of the gusts
};

/// When a pilot decides, and the decisions that its motors do not have yet.
struct ControlClock {
  int ticks_per_control = 1;
  int delay_ticks = 0;
  std::deque<std::pair<long, PerRotor>> commands = {};  ///< with the tick from which each holds
};

/// A drone, except for its body in the world.
struct FlyingDrone {
  Pilot pilot;
  ControlClock clock;
  Gusts gusts;
  Jet jet;
  FallWarning fall;
  Damage damage = {};                                 ///< so far
  Eigen::Vector3d air_mps = Eigen::Vector3d::Zero();  ///< wind at the drone
  VehicleInAir sampled = {};                          ///< as of the last samples
};

/// The drones, in the order of the world's vehicles.
struct Fleet {
  FlightWorld world;
  WindSpec wind;
  std::vector<FlyingDrone> drones;
};

/// Number of ticks nearest to the period of a frequency, at least 1.
int nearest_ticks(double hz, double tick_s);

/// All drones at their starts, in a world with ticks of `dt_s`. The planned drones must outlive the
/// fleet.
Fleet make_fleet(const std::vector<world::Building>& buildings,
                 const std::vector<PlannedDrone>& planned, double dt_s,
                 const FlightWeather& weather);

/// Lets the wind blow, and each vehicle on those below it.
void blow(Fleet& fleet, double time_s);

/// Lets those pilots decide whose turn it is, and hands the motors what they have by now.
void steer(Fleet& fleet, long tick, const Pilot::Report& report);

/// Breaks what does not withstand the impact and is not broken already, and reports it.
void break_parts(Fleet& fleet, const Impact& impact, const Pilot::Report& report);

}  // namespace throng::sim
