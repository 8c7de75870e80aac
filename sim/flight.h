// All drones of a run in the air: policies, controllers and bodies on one clock.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "sim/controller.h"
#include "sim/flight_world.h"
#include "sim/plan.h"
#include "world/trace.h"

namespace throng::sim {

/// Where a flight's record goes.
struct FlightLog {
  std::function<void(std::size_t drone, const world::DroneSample&)> sample;
  std::function<void(const world::TraceEvent&)> event;
};

class Flight {
 public:
  /// The clock runs in equal ticks of at most `physics_dt_s`, a whole number of them in
  /// `interval_s`. Records the drones' start as their first samples.
  Flight(const std::vector<world::Building>& buildings, const std::vector<PlannedDrone>& drones,
         double interval_s, double physics_dt_s, FlightLog log);

  /// Flies on for one interval; samples are about 1/60 s apart, with one at the interval's end.
  void advance();

  FlightState state(std::size_t drone) const { return world_.state(drone); }

 private:
  struct Pilot {
    std::unique_ptr<Policy> policy;
    Controller controller;
    Setpoint setpoint;
    double saturated_s = 0;  ///< how long the tilt has been at its limit without a break
  };

  void control();
  void record_samples();
  void record_impacts();

  int ticks_per_interval_;
  int ticks_per_control_;
  int ticks_per_sample_;
  double interval_s_;
  long interval_ = 0;
  long tick_ = 0;
  double time_s_ = 0;
  FlightWorld world_;
  std::vector<Pilot> pilots_;
  FlightLog log_;
};

}  // namespace throng::sim
