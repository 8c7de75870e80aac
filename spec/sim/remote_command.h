// Commands of the user who flies a drone.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <vector>

#include "spec/camera/gimbal_spec.h"

namespace throng::sim {

/// Points to be flown to one after another; the drone stays at the last one.
struct RemoteRoute {
  std::vector<Eigen::Vector3d> points;  ///< m, in the world; none: the drone only turns
  double speed_mps = 5;                 ///< between the points
  std::optional<double> yaw_rad;        ///< heading to turn to; none: as it is
};

/// A command of the user who flies a drone, valid until the next one.
struct RemoteCommand {
  /// Velocity forward, left and up in the heading frame of the drone's set-point, m/s.
  Eigen::Vector3d velocity_mps = Eigen::Vector3d::Zero();
  double yaw_rate_deg_s = 0;  ///< counter-clockwise
  bool beacon = false;
  bool goes_home = false;  ///< fly to the start; `velocity_mps` and `route` are ignored
  /// If set, `velocity_mps` is ignored, and so is the yaw rate where the route has a heading.
  /// Another object, be it equal, begins at its first point.
  std::shared_ptr<const RemoteRoute> route = nullptr;
  /// Direction to which the camera turns; none: as it is. A rigid mount has none.
  std::optional<camera::GimbalAngles> gimbal = {};
};

}  // namespace throng::sim
