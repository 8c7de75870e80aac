#include "formats/files/bag_file.h"

#include <nav_msgs/Odometry.h>
#include <rosbag/bag.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Imu.h>
#include <std_msgs/String.h>
#include <tf2_msgs/TFMessage.h>
#include <visualization_msgs/MarkerArray.h>

#include <algorithm>
#include <utility>

#include "camera/files.h"

namespace throng::formats {

namespace {

std_msgs::Header make_header(const std::string& frame, double time_s) {
  std_msgs::Header header;
  header.stamp = ros::Time(time_s);
  header.frame_id = frame;
  return header;
}

template <typename Message>
void set_vector(Message& message, const Eigen::Vector3d& vector) {
  message.x = vector.x();
  message.y = vector.y();
  message.z = vector.z();
}

template <typename Message>
void set_rotation(Message& message, const Eigen::Quaterniond& rotation) {
  message.w = rotation.w();
  message.x = rotation.x();
  message.y = rotation.y();
  message.z = rotation.z();
}

void set_pose(geometry_msgs::Pose& message, const BagPose& pose) {
  set_vector(message.position, pose.position);
  set_rotation(message.orientation, pose.rotation);
}

}  // namespace

struct BagFile::Bag {
  rosbag::Bag file;

  template <typename Message>
  void add(const std::string& topic, double time_s, const Message& message) {
    file.write(topic, std::max(ros::Time(time_s), ros::TIME_MIN), message);
  }
};

BagFile::BagFile(const std::filesystem::path& path, bool is_compressed)
    : bag_(std::make_unique<Bag>()) {
  bag_->file.open(path.string(), rosbag::bagmode::Write);
  bag_->file.setCompression(is_compressed ? rosbag::compression::LZ4
                                          : rosbag::compression::Uncompressed);
}

BagFile::~BagFile() = default;

void BagFile::add_image(const std::string& topic, const std::string& frame, double time_s,
                        const std::string& jpeg) {
  sensor_msgs::CompressedImage message;
  message.header = make_header(frame, time_s);
  message.format = "jpeg";
  message.data.assign(jpeg.begin(), jpeg.end());
  bag_->add(topic, time_s, message);
}

void BagFile::add_lens(const std::string& topic, const std::string& frame, double time_s,
                       const camera::Intrinsics& lens) {
  camera::RosLens ros = camera::ros_lens(lens);
  const Eigen::Matrix3d matrix = lens.matrix();
  sensor_msgs::CameraInfo message;
  message.header = make_header(frame, time_s);
  message.width = static_cast<std::uint32_t>(lens.width);
  message.height = static_cast<std::uint32_t>(lens.height);
  message.distortion_model = std::move(ros.model);
  message.D = std::move(ros.coefficients);
  constexpr std::size_t kSide = 3;
  for (std::size_t row = 0; row < kSide; ++row) {
    message.R[(kSide + 1) * row] = 1;
    for (std::size_t column = 0; column < kSide; ++column) {
      const double value =
          matrix(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(column));
      message.K[kSide * row + column] = value;
      message.P[(kSide + 1) * row + column] = value;
    }
  }
  bag_->add(topic, time_s, message);
}

void BagFile::add_transforms(double time_s, const std::vector<BagTransform>& transforms) {
  tf2_msgs::TFMessage message;
  for (const BagTransform& transform : transforms) {
    geometry_msgs::TransformStamped& part = message.transforms.emplace_back();
    part.header = make_header(transform.parent, time_s);
    part.child_frame_id = transform.child;
    set_vector(part.transform.translation, transform.pose.position);
    set_rotation(part.transform.rotation, transform.pose.rotation);
  }
  bag_->add("/tf", time_s, message);
}

void BagFile::add_odometry(const std::string& topic, const std::string& frame,
                           const std::string& child, double time_s, const BagMotion& motion) {
  nav_msgs::Odometry message;
  message.header = make_header(frame, time_s);
  message.child_frame_id = child;
  set_pose(message.pose.pose, motion.pose);
  set_vector(message.twist.twist.linear, motion.velocity_mps);
  set_vector(message.twist.twist.angular, motion.rates_rad_s);
  bag_->add(topic, time_s, message);
}

void BagFile::add_imu(const std::string& topic, const std::string& frame, double time_s,
                      const Eigen::Vector3d& rates, const Eigen::Vector3d& acceleration) {
  sensor_msgs::Imu message;
  message.header = make_header(frame, time_s);
  message.orientation_covariance[0] = -1;  // ROS' way to say that there is no orientation
  set_vector(message.angular_velocity, rates);
  set_vector(message.linear_acceleration, acceleration);
  bag_->add(topic, time_s, message);
}

void BagFile::add_boxes(const std::string& topic, const std::string& frame, double time_s,
                        const std::vector<BagBox>& boxes) {
  constexpr float kOpacity = 0.5F;
  visualization_msgs::MarkerArray message;
  visualization_msgs::Marker& first = message.markers.emplace_back();
  first.header = make_header(frame, time_s);
  first.action = visualization_msgs::Marker::DELETEALL;
  for (const BagBox& box : boxes) {
    visualization_msgs::Marker& marker = message.markers.emplace_back();
    marker.header = make_header(frame, time_s);
    marker.ns = "people";
    marker.id = box.id;
    marker.type = visualization_msgs::Marker::CUBE;
    marker.action = visualization_msgs::Marker::ADD;
    set_pose(marker.pose, box.pose);
    set_vector(marker.scale, box.size_m);
    marker.color.g = 1;
    marker.color.a = kOpacity;
  }
  bag_->add(topic, time_s, message);
}

void BagFile::add_text(const std::string& topic, double time_s, const std::string& text) {
  std_msgs::String message;
  message.data = text;
  bag_->add(topic, time_s, message);
}

void BagFile::close() { bag_->file.close(); }

}  // namespace throng::formats
