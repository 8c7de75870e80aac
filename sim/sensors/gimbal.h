// A camera's gimbal: it follows the drone's heading, keeps the camera level, and never quite does.
#pragma once

#include <cstdint>
#include <vector>

#include "spec/camera/camera_spec.h"
#include "world/trace.h"

namespace throng::sim {

/// Viewing direction of a camera, in radians: heading counter-clockwise from +x, angle above the
/// horizon, turn clockwise about the view's direction.
struct ViewAngles {
  double yaw = 0;
  double pitch = 0;
  double roll = 0;
};

/// Heading of a drone: where its nose points, whatever it leans.
double heading_from_orientation(const Eigen::Quaterniond& orientation);

/// Viewing direction of an ideal gimbal below a drone: that of the drone's heading and the camera's
/// mounting, level.
ViewAngles ideal_view(const Eigen::Quaterniond& orientation, const camera::CameraSpec& camera);

/// One camera's view over a run. Made from a trace alone, like SensorLog.
class GimbalLog {
 public:
  /// `index` numbers the cameras of the run. The trace has samples of its drone.
  GimbalLog(const std::vector<world::DroneSample>& truth, const camera::CameraSpec& camera,
            std::uint64_t seed, std::uint64_t index);

  /// True viewing direction of the camera.
  ViewAngles view_at(double time_s) const;
  /// Viewing direction reported by the gimbal: without its bias, which it does not know, and with
  /// the noise of its encoders.
  ViewAngles reading_at(double time_s) const;

 private:
  struct Point {
    double time_s;
    ViewAngles view;
    ViewAngles reading;
  };
  /// The points around a time, and how far it is between them.
  struct Interval {
    const Point& before;
    const Point& after;
    double share;
  };
  Interval place_of(double time_s) const;

  std::vector<Point> points_;
};

}  // namespace throng::sim
