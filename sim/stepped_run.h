// A run step by step: simulate() takes all of its steps, a live flight each when its time has come.
#pragma once

#include <memory>
#include <vector>

#include "base/error.h"
#include "sim/policies/planned_drone.h"
#include "sim/run_observer.h"
#include "sim/vehicle/pilot.h"
#include "spec/sim/run_spec.h"
#include "world/scenario.h"

namespace throng::sim {

class SteppedRun {
 public:
  /// Checks the specification, as simulate() does, and reports the start to the observer. Scenario
  /// and observer must outlive it. Throws like simulate().
  SteppedRun(const world::Scenario& scenario, const RunSpec& spec, RunObserver& observer);
  ~SteppedRun();
  SteppedRun(const SteppedRun&) = delete;
  SteppedRun& operator=(const SteppedRun&) = delete;

  /// Seconds of a step.
  double dt_s() const;
  /// Simulated seconds so far.
  double time_s() const;
  const std::vector<PlannedDrone>& drones() const;
  FlightState drone_state(std::size_t drone) const;
  const Pilot& pilot(std::size_t drone) const;

  /// Adds a set-point to those of a drone whose policy is "pilot_log"; later than all before it.
  void fly_on(std::size_t drone, const PilotSample& setpoint);

  /// Simulates one step of the crowd, and the flight meanwhile.
  void step();

  /// Reports what was still going on. Returns the warnings that simulate() returns; call nothing
  /// afterwards.
  std::vector<Problem> finish();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace throng::sim
