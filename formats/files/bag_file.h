// Writer for ROS 1 bags, through Debian's librosbag-storage. ROS's headers require C++17, so this
// header and bag_file.cpp, the only file that includes them, use no later features.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "camera/camera.h"

namespace throng::formats {

/// Pose of a frame in another: X_parent = rotation * X_child + position.
struct BagPose {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
};

/// Pose of the frame `child` in the frame `parent`.
struct BagTransform {
  std::string parent;
  std::string child;
  BagPose pose;
};

/// A drone's motion: pose in the world; velocity and angular rates in the body frame.
struct BagMotion {
  BagPose pose;
  Eigen::Vector3d velocity_mps = Eigen::Vector3d::Zero();
  Eigen::Vector3d rates_rad_s = Eigen::Vector3d::Zero();
};

/// An upright box in the world.
struct BagBox {
  std::int32_t id = 0;
  BagPose pose;  ///< of its center
  Eigen::Vector3d size_m = Eigen::Vector3d::Zero();
};

/// Times are seconds since the run's start. Bags cannot hold time 0, so messages at 0 s are
/// recorded at 1 ns. All functions throw std::runtime_error if the file cannot be written.
class BagFile {
 public:
  /// Creates or replaces the file. Chunks are compressed with LZ4 if `is_compressed`.
  BagFile(const std::filesystem::path& path, bool is_compressed);
  ~BagFile();
  BagFile(const BagFile&) = delete;
  BagFile& operator=(const BagFile&) = delete;

  /// sensor_msgs/CompressedImage with the bytes of a JPEG file.
  void add_image(const std::string& topic, const std::string& frame, double time_s,
                 const std::string& jpeg);
  /// sensor_msgs/CameraInfo.
  void add_lens(const std::string& topic, const std::string& frame, double time_s,
                const camera::Intrinsics& lens);
  /// tf2_msgs/TFMessage on /tf.
  void add_transforms(double time_s, const std::vector<BagTransform>& transforms);
  /// nav_msgs/Odometry of `child` in `frame`.
  void add_odometry(const std::string& topic, const std::string& frame, const std::string& child,
                    double time_s, const BagMotion& motion);
  /// sensor_msgs/Imu without an orientation: rad/s and m/s^2 in the body's axes.
  void add_imu(const std::string& topic, const std::string& frame, double time_s,
               const Eigen::Vector3d& rates, const Eigen::Vector3d& acceleration);
  /// visualization_msgs/MarkerArray: a marker that deletes the earlier ones, then a cube per box.
  void add_boxes(const std::string& topic, const std::string& frame, double time_s,
                 const std::vector<BagBox>& boxes);
  /// std_msgs/String.
  void add_text(const std::string& topic, double time_s, const std::string& text);
  void close();

 private:
  struct Bag;
  std::unique_ptr<Bag> bag_;
};

}  // namespace throng::formats
