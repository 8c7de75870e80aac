// The flight of all drones of a run: pilots and bodies on one clock, wind, downwash, collisions and
// near misses.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "sim/policies/planned_drone.h"
#include "sim/vehicle/damage.h"
#include "sim/vehicle/downwash_exposure.h"
#include "sim/vehicle/fall_warning.h"
#include "sim/vehicle/flight_world.h"
#include "sim/vehicle/near_misses.h"
#include "sim/vehicle/people_nearby.h"
#include "sim/vehicle/pilot.h"
#include "sim/vehicle/wind.h"
#include "world/trace.h"

namespace throng::sim {

/// Receivers of a flight's records.
struct FlightLog {
  std::function<void(std::size_t drone, const world::DroneSample&)> sample;
  std::function<void(const world::TraceEvent&)> event;
  /// A person was hit, with the horizontal impulse (N s).
  std::function<void(std::size_t agent, const Eigen::Vector2d& impulse_ns)> strike = {};
};

/// The wind of a flight.
struct FlightWeather {
  WindSpec wind;
  std::uint64_t seed = 1;  ///< seed of the gusts
};

/// When a pilot decides, and the decisions that its motors do not have yet.
struct ControlClock {
  int ticks_per_control = 1;
  int delay_ticks = 0;
  std::deque<std::pair<long, PerRotor>> commands;  ///< with the tick from which each holds
};

/// Simulates the flight of all drones. Deterministic; not thread-safe.
class Flight {
 public:
  /// The clock has equal ticks of at most `physics_dt_s`, an integer number of them in
  /// `interval_s`. Records the drones' starts as their first samples.
  Flight(const std::vector<world::Building>& buildings, const std::vector<PlannedDrone>& drones,
         double interval_s, double physics_dt_s, FlightLog log, const FlightWeather& weather = {});
  Flight(const Flight&) = delete;
  Flight& operator=(const Flight&) = delete;

  /// Simulates one interval. Samples are about 1/60 s apart; one is at the interval's end.
  /// `people_at_end` is the crowd at that time; its size must not change during a flight.
  void advance(const PeopleView& people_at_end = {});

  /// Records events that are still going on. No other method may be called afterwards.
  void finish();

  FlightState state(std::size_t drone) const { return world_.state(drone); }
  Pilot& pilot(std::size_t drone) { return pilots_[drone]; }
  const Pilot& pilot(std::size_t drone) const { return pilots_[drone]; }

 private:
  void meet_people();
  void control();
  void command();
  void blow();
  void record_samples();
  void record_impacts(std::span<const Impact> impacts);
  void damage(const Impact& impact);
  void watch_falls();
  void watch_surroundings();

  int ticks_per_interval_;
  int ticks_per_wind_;
  int ticks_per_sample_;
  double interval_s_;
  long interval_ = 0;
  long tick_ = 0;
  double time_s_ = 0;
  double sampled_s_ = 0;  ///< time of the last samples
  FlightWorld world_;
  FlightLog log_;
  WindSpec wind_;
  std::vector<Pilot> pilots_;
  std::vector<ControlClock> clocks_;  ///< of the pilots
  std::vector<Gusts> gusts_;
  std::vector<Jet> jets_;
  std::vector<FallWarning> falls_;
  std::vector<Damage> damages_;       ///< damage of each drone so far
  std::vector<FlightState> states_;   ///< when the wind was last updated
  std::vector<Eigen::Vector3d> air_;  ///< wind at each drone, m/s
  std::vector<VehicleInAir> crafts_;  ///< as of the last samples
  PeopleInMotion people_;
  std::vector<NearPerson>
      near_;  ///< people relevant to any drone in this interval, as of the last samples
  NearMisses near_misses_;
  DownwashExposure exposure_;
};

}  // namespace throng::sim
