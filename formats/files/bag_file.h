// A ROS 1 bag, written through Debian's librosbag-storage. ROS' headers are C++17 at most, so this
// one, and bag_file.cpp, which is all that sees them, do without anything later.
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

struct BagTransform {
  std::string parent;
  std::string child;
  BagPose pose;
};

/// A drone's motion: its pose in the world, and velocity and rates in its own axes.
struct BagMotion {
  BagPose pose;
  Eigen::Vector3d velocity_mps = Eigen::Vector3d::Zero();
  Eigen::Vector3d rates_rad_s = Eigen::Vector3d::Zero();
};

/// An upright box in the world.
struct BagBox {
  std::int32_t id = 0;
  BagPose pose;  ///< of its middle
  Eigen::Vector3d size_m = Eigen::Vector3d::Zero();
};

/// Stamps are seconds since the run's start. A bag has no time 0, so that what is stamped with it
/// is recorded at one nanosecond. All functions throw std::runtime_error when the disk refuses.
class BagFile {
 public:
  /// Replaces the file. Chunks are compressed with LZ4 if `is_compressed`.
  BagFile(const std::filesystem::path& path, bool is_compressed);
  ~BagFile();
  BagFile(const BagFile&) = delete;
  BagFile& operator=(const BagFile&) = delete;

  /// sensor_msgs/CompressedImage: the JPEG's bytes as they are.
  void add_image(const std::string& topic, const std::string& frame, double time_s,
                 const std::string& jpeg);
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
  /// visualization_msgs/MarkerArray: one that clears the earlier ones, then a cube per box.
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
