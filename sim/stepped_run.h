// A run that is advanced step by step: by simulate() at once, by a live flight in real time.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "base/error.h"
#include "crowd/simulation.h"
#include "sim/fleet/pilot.h"
#include "sim/policies/planned_drone.h"
#include "sim/recording/run_observer.h"
#include "spec/sim/run_spec.h"
#include "world/scenario.h"

namespace throng::sim {

/// A running simulation of a scenario. Not thread-safe.
class SteppedRun {
 public:
  /// Checks the specification and reports the start of the run to the observer. `scenario` and
  /// `observer` must outlive the run. `people` are load_people() of this run, which are loaded
  /// unless given. Throws InputError as simulate().
  SteppedRun(const world::Scenario& scenario, const RunSpec& spec, RunObserver& observer,
             std::optional<crowd::Simulation> people = std::nullopt);
  ~SteppedRun();
  SteppedRun(const SteppedRun&) = delete;
  SteppedRun& operator=(const SteppedRun&) = delete;

  /// Duration of a step (s).
  double dt_s() const;
  /// Simulated time so far (s).
  double time_s() const;
  const std::vector<PlannedDrone>& drones() const;
  FlightState drone_state(std::size_t drone) const;
  const Pilot& pilot(std::size_t drone) const;

  /// Appends a set-point, which must be later than all previous ones, for a drone with the policy
  /// "pilot_log".
  void fly_on(std::size_t drone, const PilotSample& setpoint);

  /// Simulates one step of the crowd and the flight during it.
  void step();

  /// Reports events that are still going on. Returns the warnings of simulate(), except those of
  /// PeopleWatch. No other method may be called afterwards.
  std::vector<Problem> finish();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace throng::sim
