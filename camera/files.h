// Camera calibrations in the formats of OpenCV and ROS.
#pragma once

#include <string>
#include <vector>

#include "camera/camera.h"

namespace throng::camera {

/// Distortion as in sensor_msgs/CameraInfo: the model plumb_bob, rational_polynomial or
/// equidistant, with its coefficients in the model's order.
struct RosLens {
  std::string model;
  std::vector<double> coefficients;
};
RosLens ros_lens(const Intrinsics& intrinsics);

/// YAML for cv::FileStorage: image_width, image_height, camera_matrix, distortion_model and
/// distortion_coefficients in OpenCV's order (k1, k2, p1, p2, k3, k4, k5, k6; fisheye: k1 to k4).
std::string opencv_yaml(const Intrinsics& intrinsics);

/// YAML for ROS' camera_info_manager (sensor_msgs/CameraInfo).
std::string ros_yaml(const Intrinsics& intrinsics, const std::string& camera_name);

}  // namespace throng::camera
