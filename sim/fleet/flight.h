// The flight of all drones of a run: pilots and bodies on one clock, wind, downwash, collisions and
// near misses.
#pragma once

#include <functional>
#include <vector>

#include "sim/fleet/fleet.h"
#include "sim/vehicle/downwash_exposure.h"
#include "sim/vehicle/near_misses.h"
#include "sim/vehicle/people_nearby.h"
#include "world/trace.h"

namespace throng::sim {

/// Receivers of a flight's records.
struct FlightLog {
  std::function<void(std::size_t drone, const world::DroneSample&)> sample;
  std::function<void(const world::TraceEvent&)> event;
  /// A person was hit, with the horizontal impulse (N s).
  std::function<void(std::size_t agent, const Eigen::Vector2d& impulse_ns)> strike = {};
};

/// Equal ticks, a whole number of them in each interval.
struct FlightClock {
  double interval_s = 0;
  int ticks_per_interval = 1;
  int ticks_per_wind = 1;
  int ticks_per_sample = 1;
  long tick = 0;
  double sampled_s = 0;  ///< time of the last samples

  double tick_s() const { return interval_s / ticks_per_interval; }
  /// Counted from the interval's start, so that no rounding adds up over a run.
  double time_s() const;
  bool is_interval_over() const { return tick % ticks_per_interval == 0; }
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

  FlightState state(std::size_t drone) const { return fleet_.world.state(drone); }
  Pilot& pilot(std::size_t drone) { return fleet_.drones[drone].pilot; }
  const Pilot& pilot(std::size_t drone) const { return fleet_.drones[drone].pilot; }

 private:
  void record_samples();
  void record_impacts(std::span<const Impact> impacts);

  FlightClock clock_;
  Fleet fleet_;
  FlightLog log_;
  MovingPeople people_;
  /// People relevant to any drone in this interval, as of the last samples.
  std::vector<NearPerson> near_;
  NearMisses near_misses_;
  DownwashExposure exposure_;
};

}  // namespace throng::sim
