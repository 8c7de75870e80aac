// Cameras among the <sensor>s of robots and worlds. SI units.
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>

namespace sdf {
inline namespace v12 {
class Sensor;
}  // namespace v12
}  // namespace sdf

namespace throng::imports {

/// Brown-Conrady coefficients, named as in OpenCV.
struct CameraDistortion {
  double k1 = 0;
  double k2 = 0;
  double k3 = 0;
  double p1 = 0;
  double p2 = 0;
  bool is_zero() const { return k1 == 0 && k2 == 0 && k3 == 0 && p1 == 0 && p2 == 0; }
};

/// A camera. Its frame has x along the optical axis and z up, as Gazebo's.
struct CameraSensor {
  std::string name;
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();  ///< in the frame of its robot or world
  bool is_movable = false;                                 ///< on joints that turn: a gimbal
  bool is_color = true;                                    ///< false: depth or thermal only
  bool has_noise = false;
  int width = 0;
  int height = 0;
  double hfov_rad = 0;
  /// Focal lengths and principal point in pixels, if the lens states them.
  std::optional<Eigen::Vector4d> intrinsics_px;
  CameraDistortion distortion;
};

bool is_camera(const sdf::Sensor& sensor);

/// Reads a camera whose link has the pose `link`. Nothing if it has no <camera>, or a pose relative
/// to a frame that does not exist.
std::optional<CameraSensor> read_camera_sensor(const sdf::Sensor& sensor,
                                               const Eigen::Isometry3d& link);

}  // namespace throng::imports
