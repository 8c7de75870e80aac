// All drones of a run in the air: pilots and bodies on one clock, the wind, and what drones do to
// each other and to people.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
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

/// Output of a flight's record.
struct FlightLog {
  std::function<void(std::size_t drone, const world::DroneSample&)> sample;
  std::function<void(const world::TraceEvent&)> event;
  /// Somebody was hit, and how hard (N s, on the ground).
  std::function<void(std::size_t agent, const Eigen::Vector2d& impulse_ns)> strike = {};
};

/// The air that a flight goes through.
struct FlightWeather {
  WindSpec wind;
  std::uint64_t seed = 1;  ///< of the gusts
};

class Flight {
 public:
  /// The clock runs in equal ticks of at most `physics_dt_s`, a whole number of them in
  /// `interval_s`. Records the drones' start as their first samples.
  Flight(const std::vector<world::Building>& buildings, const std::vector<PlannedDrone>& drones,
         double interval_s, double physics_dt_s, FlightLog log, const FlightWeather& weather = {});
  Flight(const Flight&) = delete;
  Flight& operator=(const Flight&) = delete;

  /// Flies on for one interval; samples are about 1/60 s apart, with one at the interval's end.
  /// `people_at_end` is the crowd as it is then; its size must not change during a flight.
  void advance(const PeopleView& people_at_end = {});

  /// Records events that are still going on. Call nothing afterwards.
  void finish();

  FlightState state(std::size_t drone) const { return world_.state(drone); }
  Pilot& pilot(std::size_t drone) { return pilots_[drone]; }
  const Pilot& pilot(std::size_t drone) const { return pilots_[drone]; }

 private:
  void meet_people();
  void control();
  void blow();
  void record_samples();
  void record_impacts(std::span<const Impact> impacts);
  void damage(const Impact& impact);
  void watch_falls();
  void watch_surroundings();

  int ticks_per_interval_;
  int ticks_per_control_;
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
  std::vector<Gusts> gusts_;
  std::vector<Jet> jets_;
  std::vector<FallWarning> falls_;
  std::vector<Damage> damages_;       ///< of each drone so far
  std::vector<FlightState> states_;   ///< when the pilots last decided
  std::vector<Eigen::Vector3d> air_;  ///< wind at each drone, m/s
  std::vector<VehicleInAir> crafts_;  ///< as of the last samples
  PeopleInMotion people_;
  std::vector<NearPerson>
      near_;  ///< who matters to some drone in this interval, as of last samples
  NearMisses near_misses_;
  DownwashExposure exposure_;
};

}  // namespace throng::sim
