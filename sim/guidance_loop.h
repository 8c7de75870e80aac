// Couples crowd and drones: passes observations of the crowd to the drones' policies, and moves the
// goals of people who follow drones.
#pragma once

#include <optional>
#include <vector>

#include "sim/fleet/flight.h"
#include "sim/people/crowd_source.h"
#include "sim/policies/planned_drone.h"
#include "sim/recording/crowd_recorder.h"
#include "sim/sensors/perception.h"

namespace throng::sim {

/// The coupling of one run.
class GuidanceLoop {
 public:
  /// `scenario`, `roles` and `drones` must outlive the loop.
  GuidanceLoop(const world::Scenario& scenario, const std::vector<world::AgentRole>& roles,
               const std::vector<PlannedDrone>& drones, std::uint64_t seed, double step_s);

  /// Passes the state of the world at `time_s` to the policies in the order of the drones. Each
  /// policy sees the plans that previous policies have just made.
  void look(const CrowdSource& crowd, const CrowdRecorder& recorder, Flight& flight, double time_s);

  /// Reports the drones' set-points to the observer.
  void report(const Flight& flight, RunObserver& observer) const;

  /// Moves the goals of drones to the ground below them, and those of drones that do not lead out
  /// of people's sight.
  void move_goals(const Flight& flight, CrowdSource& crowd) const;

 private:
  static DroneSeen seen(const Flight& flight, std::size_t drone);

  const std::vector<PlannedDrone>& drones_;
  std::vector<std::optional<world::GoalRef>> goals_;  // per drone
  CrowdObserver observer_;
  std::vector<bool> has_gimbal_;  // per drone: its set-points turn the camera
  std::vector<std::optional<CameraPerception>> cameras_;  // per drone; nothing: sees the truth
};

}  // namespace throng::sim
