// ROS 2 messages as CDR, each with its definition in the text of ros2msg, for MCAP recordings.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "camera/camera.h"
#include "formats/files/mcap_file.h"

namespace throng::formats::ros {

/// Kinds of messages that recordings hold.
enum class Kind : std::uint8_t {
  clock,             ///< rosgraph_msgs/msg/Clock
  transforms,        ///< tf2_msgs/msg/TFMessage
  image,             ///< sensor_msgs/msg/Image
  compressed_image,  ///< sensor_msgs/msg/CompressedImage
  camera_info,       ///< sensor_msgs/msg/CameraInfo
  imu,               ///< sensor_msgs/msg/Imu
  fix,               ///< sensor_msgs/msg/NavSatFix
  magnetic_field,    ///< sensor_msgs/msg/MagneticField
  pressure,          ///< sensor_msgs/msg/FluidPressure
  odometry,          ///< nav_msgs/msg/Odometry
  velocity,          ///< geometry_msgs/msg/TwistStamped
  detections_2d,     ///< vision_msgs/msg/Detection2DArray
  detections_3d,     ///< vision_msgs/msg/Detection3DArray
  markers,           ///< visualization_msgs/msg/MarkerArray
  text,              ///< std_msgs/msg/String
};

/// The definition of a kind, with the definitions of all messages in it.
McapSchema make_schema(Kind kind);

/// Time of a message, from the run's start.
std::uint64_t time_ns(double time_s);

/// Frame and time of a message.
struct Header {
  std::string frame;
  double time_s = 0;
};

/// Pose of a frame in another: X_parent = rotation * X_child + position.
struct Pose {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
};

/// Pose of the frame `child` in the frame `parent`.
struct Transform {
  std::string parent;
  std::string child;
  Pose pose;
};

/// Pose in the world; velocity (m/s) and angular rates (rad/s) in the body frame.
struct Motion {
  Pose pose;
  Eigen::Vector3d velocity_mps = Eigen::Vector3d::Zero();
  Eigen::Vector3d rates_rad_s = Eigen::Vector3d::Zero();
};

/// A box around somebody or something.
struct Box3 {
  std::int64_t id = 0;  ///< the track, the same in all messages of a recording
  std::string label;    ///< class
  Pose pose;            ///< of its center
  Eigen::Vector3d size_m = Eigen::Vector3d::Zero();
};

/// A box in the image, in pixels: pixel i covers [i, i + 1).
struct Box2 {
  std::int64_t id = 0;
  std::string label;
  Eigen::Vector2d center_px = Eigen::Vector2d::Zero();
  Eigen::Vector2d size_px = Eigen::Vector2d::Zero();
};

/// A position on the ellipsoid WGS 84.
struct Fix {
  double latitude_deg = 0;
  double longitude_deg = 0;
  double altitude_m = 0;
  Eigen::Vector3d sd_m = Eigen::Vector3d::Zero();  ///< east, north, up
};

/// An image without compression, row by row.
struct Pixels {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::string encoding;  ///< such as 32FC1, mono16
  std::uint32_t bytes_per_pixel = 0;
  std::string_view data;
};

std::string clock(double time_s);
std::string transforms(double time_s, const std::vector<Transform>& transforms);
std::string image(const Header& header, const Pixels& pixels);
/// `bytes` are those of a file in this format, such as jpeg.
std::string compressed_image(const Header& header, std::string_view format, std::string_view bytes);
std::string camera_info(const Header& header, const camera::Intrinsics& lens);
/// Without an orientation: rad/s and m/s² in the body's axes.
std::string imu(const Header& header, const Eigen::Vector3d& rates,
                const Eigen::Vector3d& acceleration);
std::string fix(const Header& header, const Fix& fix);
/// Tesla, in the body's axes.
std::string magnetic_field(const Header& header, const Eigen::Vector3d& field_t);
std::string pressure(const Header& header, double pressure_pa);
std::string odometry(const Header& header, const std::string& child, const Motion& motion);
/// Velocity and angular rates in the header's frame.
std::string velocity(const Header& header, const Eigen::Vector3d& velocity_mps,
                     const Eigen::Vector3d& rates_rad_s = Eigen::Vector3d::Zero());
std::string detections_2d(const Header& header, const std::vector<Box2>& boxes);
std::string detections_3d(const Header& header, const std::vector<Box3>& boxes);
/// A marker that deletes the earlier ones, then a cube per box.
std::string markers(const Header& header, const std::vector<Box3>& boxes);
std::string text(std::string_view text);

}  // namespace throng::formats::ros
