// Drones that people fly: their commands become the set-points of a pilot log, and the drones fly
// by these alone, so that the log repeats the flight exactly.
//
// A set-point is for 3 ms after the end of a step: the autopilot then never needs one that is later
// than the last, and a run that knows all of them does what one did that got them step by step.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "sim/stepped_run.h"
#include "spec/sim/run_spec.h"
#include "world/scenario.h"

namespace throng::sim {

/// Limits of what can be commanded.
inline constexpr double kMaxRemoteSpeedMps = 10;  ///< over the ground
inline constexpr double kMaxRemoteClimbMps = 3;
inline constexpr double kMaxRemoteYawDegS = 120;

/// A wish of somebody who flies a drone, in force until the next one.
struct RemoteCommand {
  /// Ahead, to the left and up, as the drone's set-point heads, m/s.
  Eigen::Vector3d velocity_mps = Eigen::Vector3d::Zero();
  double yaw_rate_deg_s = 0;  ///< counter-clockwise
  bool beacon = false;
  bool goes_home = false;  ///< to its start, instead of by `velocity_mps`
};

/// Lets all drones of the specification fly by pilot logs, which hold their starts. Drones without
/// a start get none: SteppedRun refuses them.
void fly_remotely(RunSpec& spec, const world::Scenario& scenario);

class RemotePilots {
 public:
  /// The run's drones fly remotely; their specification holds the first set-points. All must
  /// outlive it.
  RemotePilots(const world::Scenario& scenario, SteppedRun& run, const RunSpec& spec);

  /// To be called before each step of the run: a command per drone. Set-points keep out of
  /// buildings, off the ground and away from each other, as a job's pilot logs must, speed up and
  /// slow down gently, and wait for a drone that is left behind.
  void advance(const std::vector<RemoteCommand>& commands);

  /// All set-points so far, the starts included.
  const std::vector<PilotSample>& log(std::size_t drone) const { return logs_[drone]; }

 private:
  Eigen::Vector3d wanted_velocity(std::size_t drone, const RemoteCommand& command) const;
  bool is_free(std::size_t drone, const Eigen::Vector3d& to) const;
  double room_m(std::size_t one, const Eigen::Vector3d& place, std::size_t other) const;

  const world::Scenario& scenario_;
  SteppedRun& run_;
  std::vector<std::vector<PilotSample>> logs_;  ///< per drone
  std::vector<Eigen::Vector3d> velocities_;     ///< of the set-points, m/s
};

}  // namespace throng::sim
