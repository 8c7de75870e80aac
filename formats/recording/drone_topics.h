// Topics of one drone: transforms, motion, sensors and images.
#pragma once

#include <Eigen/Core>
#include <string>
#include <string_view>

#include "camera/camera.h"
#include "formats/recording/message_sink.h"
#include "formats/recording/sensor_row.h"

namespace throng::formats::ros {

/// Latitude and accuracy of a drone's GPS.
struct GpsTraits {
  double latitude_deg = 0;  ///< of the world's origin
  Eigen::Vector3d position_sd_m = Eigen::Vector3d::Zero();
};

/// The pose of a camera in the world.
Pose camera_pose(const camera::Pose& camera);

/// Publishes the messages of a drone. Frames: NAME/base_link (x ahead, y left, z up) and
/// NAME/camera_optical_frame (x right, y down, z ahead).
class DroneTopics {
 public:
  /// `name` comes from RosNames.
  DroneTopics(const std::string& name, MessageSink sink);

  const std::string& root() const { return root_; }  ///< of its topics: "/" and the name
  const std::string& body_frame() const { return body_frame_; }
  const std::string& optical_frame() const { return optical_frame_; }

  /// /tf: the drone in the world, and its camera, whose pose in the world is given.
  void publish_transforms(double time_s, const Pose& body, const Pose& camera) const;
  /// /tf: a camera without a drone.
  void publish_camera(double time_s, const Pose& camera) const;
  /// The true motion.
  void publish_odometry(double time_s, const Motion& motion) const;
  /// Readings, and the fix of the GPS where it is a new one. Rows come in the order of time.
  void publish_readings(const SensorRow& row, const GpsTraits& gps);
  /// The lens and an image file in a format such as jpeg.
  void publish_image(double time_s, const camera::Intrinsics& lens, std::string_view format,
                     std::string_view bytes) const;

 private:
  void publish(const char* topic, Kind kind, double time_s, std::string bytes) const;

  MessageSink sink_;
  std::string root_;
  std::string body_frame_;
  std::string optical_frame_;
  double last_fix_s_ = -1;
};

}  // namespace throng::formats::ros
