#include "formats/files/ros_messages.h"

#include <algorithm>
#include <cmath>

#include "camera/files.h"
#include "formats/files/cdr.h"

namespace throng::formats::ros {

namespace {

constexpr double kNsPerS = 1e9;
constexpr std::array<double, 9> kUnknown9{};
constexpr std::array<double, 36> kUnknown36{};

CdrWriter& add_time(CdrWriter& cdr, double time_s) {
  const std::uint64_t ns = time_ns(time_s);
  constexpr std::uint64_t kPerSecond = 1'000'000'000;
  return cdr.add(static_cast<std::int32_t>(ns / kPerSecond))
      .add(static_cast<std::uint32_t>(ns % kPerSecond));
}

CdrWriter& add_header(CdrWriter& cdr, const Header& header) {
  return add_time(cdr, header.time_s).add(header.frame);
}

CdrWriter& add_pose(CdrWriter& cdr, const Pose& pose) {
  return cdr.add(pose.position).add(pose.rotation);
}

/// vision_msgs/ObjectHypothesisWithPose with certainty.
void add_hypothesis(CdrWriter& cdr, const std::string& label, const Pose& pose) {
  add_pose(cdr.count(1).add(label).add(1.0), pose).add_all(kUnknown36);
}

void add_marker(CdrWriter& cdr, const Header& header, const Box3* box) {
  constexpr std::int32_t kCube = 1;
  constexpr std::int32_t kArrow = 0;
  constexpr std::int32_t kAdd = 0;
  constexpr std::int32_t kDeleteAll = 3;
  constexpr float kOpacity = 0.5F;
  add_header(cdr, header).add("people");
  cdr.add(static_cast<std::int32_t>(box != nullptr ? box->id : 0))
      .add(box != nullptr ? kCube : kArrow)
      .add(box != nullptr ? kAdd : kDeleteAll);
  add_pose(cdr, box != nullptr ? box->pose : Pose{});
  cdr.add(box != nullptr ? box->size_m : Eigen::Vector3d::Zero().eval());
  cdr.add(0.0F).add(1.0F).add(0.0F).add(kOpacity);
  cdr.add(std::int32_t{0}).add(std::uint32_t{0});  // lifetime: until deleted
  cdr.add(false);                                  // frame_locked
  cdr.count(0).count(0);                           // points, colors
  cdr.add("");                                     // texture_resource
  add_header(cdr, {"", 0});                        // texture: an empty CompressedImage
  cdr.add("").count(0);
  cdr.count(0);          // uv_coordinates
  cdr.add("").add("");   // text, mesh_resource
  cdr.add("").count(0);  // mesh_file
  cdr.add(false);        // mesh_use_embedded_materials
}

}  // namespace

std::uint64_t time_ns(double time_s) {
  return static_cast<std::uint64_t>(std::llround(kNsPerS * std::max(0.0, time_s)));
}

std::string clock(double time_s) {
  CdrWriter cdr;
  add_time(cdr, time_s);
  return cdr.bytes();
}

std::string transforms(double time_s, const std::vector<Transform>& transforms) {
  CdrWriter cdr;
  cdr.count(transforms.size());
  for (const Transform& transform : transforms) {
    add_header(cdr, {transform.parent, time_s}).add(transform.child);
    add_pose(cdr, transform.pose);
  }
  return cdr.bytes();
}

std::string image(const Header& header, const Pixels& pixels) {
  CdrWriter cdr;
  add_header(cdr, header).add(pixels.height).add(pixels.width).add(pixels.encoding);
  cdr.add(std::uint8_t{0}).add(pixels.width * pixels.bytes_per_pixel).add_bytes(pixels.data);
  return cdr.bytes();
}

std::string compressed_image(const Header& header, std::string_view format,
                             std::string_view bytes) {
  CdrWriter cdr;
  add_header(cdr, header).add(format).add_bytes(bytes);
  return cdr.bytes();
}

std::string camera_info(const Header& header, const camera::Intrinsics& lens) {
  const camera::RosLens ros = camera::ros_lens(lens);
  const Eigen::Matrix3d k = lens.matrix();
  CdrWriter cdr;
  add_header(cdr, header);
  cdr.add(static_cast<std::uint32_t>(lens.height)).add(static_cast<std::uint32_t>(lens.width));
  cdr.add(ros.model).count(ros.coefficients.size()).add_all(ros.coefficients);
  for (int row = 0; row < 3; ++row) cdr.add(Eigen::Vector3d(k.row(row)));
  for (int row = 0; row < 3; ++row) cdr.add(Eigen::Vector3d(Eigen::Vector3d::Unit(row)));
  for (int row = 0; row < 3; ++row) cdr.add(Eigen::Vector3d(k.row(row))).add(0.0);
  cdr.add(std::uint32_t{0}).add(std::uint32_t{0});        // binning
  for (int i = 0; i < 4; ++i) cdr.add(std::uint32_t{0});  // region of interest: all
  cdr.add(false);
  return cdr.bytes();
}

std::string imu(const Header& header, const Eigen::Vector3d& rates,
                const Eigen::Vector3d& acceleration) {
  constexpr std::array<double, 9> kNoOrientation{-1};  // ROS' way to say so
  CdrWriter cdr;
  add_header(cdr, header).add(Eigen::Quaterniond::Identity()).add_all(kNoOrientation);
  cdr.add(rates).add_all(kUnknown9).add(acceleration).add_all(kUnknown9);
  return cdr.bytes();
}

std::string fix(const Header& header, const Fix& fix) {
  constexpr std::int8_t kFix = 0;
  constexpr std::uint16_t kGps = 1;
  constexpr std::uint8_t kDiagonalKnown = 2;
  std::array<double, 9> covariance{};
  for (std::size_t i = 0; i < 3; ++i) {
    const double sd_m = fix.sd_m[static_cast<int>(i)];
    covariance[4 * i] = sd_m * sd_m;
  }
  CdrWriter cdr;
  add_header(cdr, header).add(kFix).add(kGps);
  cdr.add(fix.latitude_deg).add(fix.longitude_deg).add(fix.altitude_m);
  cdr.add_all(covariance).add(kDiagonalKnown);
  return cdr.bytes();
}

std::string magnetic_field(const Header& header, const Eigen::Vector3d& field_t) {
  CdrWriter cdr;
  add_header(cdr, header).add(field_t).add_all(kUnknown9);
  return cdr.bytes();
}

std::string pressure(const Header& header, double pressure_pa) {
  CdrWriter cdr;
  add_header(cdr, header).add(pressure_pa).add(0.0);
  return cdr.bytes();
}

std::string odometry(const Header& header, const std::string& child, const Motion& motion) {
  CdrWriter cdr;
  add_header(cdr, header).add(child);
  add_pose(cdr, motion.pose).add_all(kUnknown36);
  cdr.add(motion.velocity_mps).add(motion.rates_rad_s).add_all(kUnknown36);
  return cdr.bytes();
}

std::string velocity(const Header& header, const Eigen::Vector3d& velocity_mps,
                     const Eigen::Vector3d& rates_rad_s) {
  CdrWriter cdr;
  add_header(cdr, header).add(velocity_mps).add(rates_rad_s);
  return cdr.bytes();
}

std::string detections_2d(const Header& header, const std::vector<Box2>& boxes) {
  CdrWriter cdr;
  add_header(cdr, header).count(boxes.size());
  for (const Box2& box : boxes) {
    add_header(cdr, header);
    add_hypothesis(cdr, box.label, {});
    cdr.add(box.center_px.x()).add(box.center_px.y()).add(0.0);
    cdr.add(box.size_px.x()).add(box.size_px.y());
    cdr.add(std::to_string(box.id));
  }
  return cdr.bytes();
}

std::string detections_3d(const Header& header, const std::vector<Box3>& boxes) {
  CdrWriter cdr;
  add_header(cdr, header).count(boxes.size());
  for (const Box3& box : boxes) {
    add_header(cdr, header);
    add_hypothesis(cdr, box.label, box.pose);
    add_pose(cdr, box.pose).add(box.size_m).add(std::to_string(box.id));
  }
  return cdr.bytes();
}

std::string markers(const Header& header, const std::vector<Box3>& boxes) {
  CdrWriter cdr;
  cdr.count(boxes.size() + 1);
  add_marker(cdr, header, nullptr);
  for (const Box3& box : boxes) add_marker(cdr, header, &box);
  return cdr.bytes();
}

std::string text(std::string_view text) {
  CdrWriter cdr;
  cdr.add(text);
  return cdr.bytes();
}

}  // namespace throng::formats::ros
