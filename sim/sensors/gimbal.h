// The gimbal of a camera, which follows the drone's heading and keeps the camera level, with the
// errors of spec/camera/gimbal_spec.h.
#pragma once

#include <cstdint>
#include <vector>

#include "spec/camera/camera_spec.h"
#include "spec/sim/run_spec.h"
#include "world/trace.h"

namespace throng::sim {

/// Viewing direction of a camera, in radians: yaw counter-clockwise from +x, pitch above the
/// horizon, roll clockwise about the viewing direction.
struct ViewAngles {
  double yaw = 0;
  double pitch = 0;
  double roll = 0;
};

/// Heading of a drone (rad, counter-clockwise from +x): the horizontal direction of its nose,
/// independent of its tilt.
double heading_from_orientation(const Eigen::Quaterniond& orientation);

/// Viewing direction with an ideal gimbal, the drone's heading plus the camera's yaw, the camera's
/// pitch, no roll; or of a rigid mount, which tilts with the drone.
ViewAngles ideal_view(const Eigen::Quaterniond& orientation, const camera::CameraSpec& camera);
/// The same at a time of a flight by these set-points, which may turn the gimbal.
ViewAngles ideal_view(const Eigen::Quaterniond& orientation, const camera::CameraSpec& camera,
                      const std::vector<PilotSample>& setpoints, double time_s);

/// The viewing direction of a camera over a run, computed from a trace, as SensorLog.
class GimbalLog {
 public:
  /// `truth` are the trace's samples of the drone, at least one. `index`, the index of the camera
  /// in the run, makes the errors of cameras independent. `setpoints` are the drone's.
  GimbalLog(const std::vector<world::DroneSample>& truth, const camera::CameraSpec& camera,
            std::uint64_t seed, std::uint64_t index,
            const std::vector<PilotSample>& setpoints = {});

  /// The true viewing direction at a time.
  ViewAngles view_at(double time_s) const;
  /// The viewing direction that the gimbal reports: without the unknown bias, and with the noise of
  /// the encoders.
  ViewAngles reading_at(double time_s) const;

 private:
  struct Point {
    double time_s;
    ViewAngles view;
    ViewAngles reading;
  };
  /// The points before and after a time, and the time's position between them (0 to 1).
  struct Interval {
    const Point& before;
    const Point& after;
    double share;
  };
  Interval place_of(double time_s) const;

  std::vector<Point> points_;
};

}  // namespace throng::sim
