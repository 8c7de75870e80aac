// Couples crowd and drones: shows the drones' policies the crowd, and lets people see the drones.
#pragma once

#include <optional>
#include <vector>

#include "sim/people/crowd_source.h"
#include "sim/policies/planned_drone.h"
#include "sim/recording/crowd_recorder.h"
#include "sim/sensors/perception.h"
#include "sim/vehicle/flight.h"

namespace throng::sim {

class GuidanceLoop {
 public:
  /// All but the numbers must outlive it.
  GuidanceLoop(const world::Scenario& scenario, const std::vector<world::AgentRole>& roles,
               const std::vector<PlannedDrone>& drones, std::uint64_t seed, double step_s);

  /// Shows every policy the world as it is at `time_s`, one after the other: each knows the plans
  /// that those before it have just made.
  void look(const CrowdSource& crowd, const CrowdRecorder& recorder, Flight& flight, double time_s);

  /// Reports the drones' destinations.
  void report(const Flight& flight, RunObserver& observer) const;

  /// Puts the goals that drones move below them; those of drones that lead nobody are out of sight.
  void move_goals(const Flight& flight, CrowdSource& crowd) const;

 private:
  static DroneSeen seen(const Flight& flight, std::size_t drone);

  const std::vector<PlannedDrone>& drones_;
  std::vector<std::optional<world::GoalRef>> goals_;  // per drone
  CrowdObserver observer_;
  std::vector<std::optional<CameraPerception>> cameras_;  // per drone; none: sees the truth
};

}  // namespace throng::sim
