// Drones that users fly. Commands are converted to set-points of a pilot log, which alone determine
// the flight, so that the log repeats it exactly.
//
// The time of each set-point is 3 ms after the end of a step. The autopilot therefore never needs a
// later one, and a run that has all set-points from the start equals one that receives them step by
// step.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <vector>

#include "sim/stepped_run.h"
#include "spec/sim/remote_command.h"
#include "spec/sim/run_spec.h"
#include "world/scenario.h"

namespace throng::sim {

/// Limits of commands.
inline constexpr double kMaxRemoteSpeedMps = 10;  ///< horizontal
inline constexpr double kMaxRemoteClimbMps = 3;
inline constexpr double kMaxRemoteYawDegS = 120;
inline constexpr double kMaxRemoteGimbalDegS = 60;  ///< of each axis

/// Changes all drones of `spec` to the policy "pilot_log" with their starts as first set-points.
/// Drones without a start get no set-point, so that SteppedRun refuses them.
void fly_remotely(RunSpec& spec, const world::Scenario& scenario);

/// Converts commands to set-points of a run's drones.
class RemotePilots {
 public:
  /// `spec`, after fly_remotely(), is the specification of `run`. `scenario` and `run` must outlive
  /// this object.
  RemotePilots(const world::Scenario& scenario, SteppedRun& run, const RunSpec& spec);

  /// Adds a set-point per drone from `commands`, one per drone; call it before each step of the
  /// run. Set-points keep clear of buildings, the ground and each other, as the pilot logs of a job
  /// must, have limited acceleration, and wait for a drone that falls behind.
  void advance(const std::vector<RemoteCommand>& commands);

  /// All set-points of a drone so far, including its start.
  const std::vector<PilotSample>& log(std::size_t drone) const { return logs_[drone]; }

 private:
  /// A drone's progress along its route.
  struct Progress {
    std::shared_ptr<const RemoteRoute> route;
    std::size_t next = 0;  ///< index of the point to which it flies
  };

  Eigen::Vector3d wanted_velocity(std::size_t drone, const RemoteCommand& command);
  Eigen::Vector3d velocity_along(std::size_t drone, const RemoteRoute& route);
  Eigen::Vector3d velocity_to(std::size_t drone, const Eigen::Vector3d& point,
                              double speed_mps) const;
  Eigen::Vector3d kept_near(std::size_t drone, const Eigen::Vector3d& velocity) const;
  double wanted_yaw_rate(std::size_t drone, const RemoteCommand& command) const;
  std::optional<camera::GimbalAngles> next_gimbal(std::size_t drone,
                                                  const RemoteCommand& command) const;
  bool is_free(std::size_t drone, const Eigen::Vector3d& to) const;
  double room_m(std::size_t one, const Eigen::Vector3d& place, std::size_t other) const;

  const world::Scenario& scenario_;
  SteppedRun& run_;
  std::vector<std::vector<PilotSample>> logs_;  ///< per drone
  std::vector<Eigen::Vector3d> velocities_;     ///< of the set-points, m/s
  std::vector<Progress> progress_;              ///< per drone
};

}  // namespace throng::sim
