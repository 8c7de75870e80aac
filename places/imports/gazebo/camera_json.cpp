#include "places/imports/gazebo/camera_json.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/geometry/angle.h"
#include "spec/job/spec.h"

namespace throng::imports {

using Eigen::Vector3d;
using nlohmann::json;
using nlohmann::ordered_json;

namespace {

double degrees(double angle_rad) {
  constexpr double kUnitDeg = 0.01;
  const double rounded = std::round(angle_rad / kDegree / kUnitDeg) / std::round(1 / kUnitDeg);
  return rounded == 0 ? 0 : rounded;
}

double meters(double length_m) {
  constexpr double kPerMeter = 1e5;
  const double rounded = std::round(length_m * kPerMeter) / kPerMeter;
  return rounded == 0 ? 0 : rounded;
}

void add_direction(const CameraSensor& camera, ordered_json& fields,
                   std::vector<std::string>& assumptions) {
  const Vector3d ahead = camera.pose.linear().col(0);
  const Vector3d up = camera.pose.linear().col(2);
  const double pitch_rad = std::asin(std::clamp(ahead.z(), -1.0, 1.0));
  // The upper side of the image says where a camera turns that looks straight down.
  const bool is_steep = ahead.head<2>().norm() < 1e-3;
  const Vector3d heading = is_steep ? Vector3d(-std::copysign(1.0, ahead.z()) * up) : ahead;
  const double yaw_rad = std::atan2(heading.y(), heading.x());
  fields["pitch_deg"] = degrees(pitch_rad);
  fields["yaw_deg"] = degrees(yaw_rad);
  const Vector3d upright(-std::sin(pitch_rad) * std::cos(yaw_rad),
                         -std::sin(pitch_rad) * std::sin(yaw_rad), std::cos(pitch_rad));
  const double roll_rad = std::acos(std::clamp(up.dot(upright), -1.0, 1.0));
  if (roll_rad > kDegree) {
    assumptions.push_back(
        fmt::format("camera: {} is turned by {:.1f} degrees about its axis, "
                    "which cameras of drones are not",
                    camera.name, roll_rad / kDegree));
  }
}

void add_lens(const CameraSensor& camera, ordered_json& fields) {
  if (camera.intrinsics_px) {
    const Eigen::Vector4d& k = *camera.intrinsics_px;
    constexpr double kHalfPixel = 0.5;  // pixels' centers: Gazebo's corners begin at 0
    fields["fx_px"] = k[0];
    fields["fy_px"] = k[1];
    fields["cx_px"] = k[2] - kHalfPixel;
    fields["cy_px"] = k[3] - kHalfPixel;
  } else {
    fields["hfov_deg"] = degrees(camera.hfov_rad);
  }
  const CameraDistortion& d = camera.distortion;
  if (d.is_zero()) return;
  fields["model"] = "brown_conrady";
  fields["distortion"] = {{"k1", d.k1}, {"k2", d.k2}, {"k3", d.k3}, {"p1", d.p1}, {"p2", d.p2}};
}

}  // namespace

ordered_json camera_json(const CameraSensor& camera, const Vector3d& center,
                         std::vector<std::string>& assumptions) {
  ordered_json fields = {{"width", camera.width}, {"height", camera.height}};
  add_lens(camera, fields);
  add_direction(camera, fields, assumptions);
  const Vector3d mount = camera.pose.translation() - center;
  fields["mount"] = {
      {"x_m", meters(mount.x())}, {"y_m", meters(mount.y())}, {"z_m", meters(mount.z())}};
  fields["gimbal"] = {{"model", camera.is_movable ? "ideal" : "rigid"}};
  return fields;
}

std::optional<std::string> camera_refusal(const ordered_json& camera) {
  const json drone = {{"id", "d1"}, {"camera", camera}};
  const json job = {{"scenario", "city_square/everyday"}, {"drones", json::array({drone})}};
  try {
    jobs::check_and_read_job(job, "");
  } catch (const InputError& error) {
    const Problem& problem = error.problems().front();
    const std::string field = problem.where.substr(problem.where.rfind('/') + 1);
    return fmt::format("its {} is {}; a job's camera has {}", field, problem.found,
                       problem.expected);
  }
  return std::nullopt;
}

}  // namespace throng::imports
