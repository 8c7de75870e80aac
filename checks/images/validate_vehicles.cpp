// Vehicles stand: where they are, how they head and how large they are stays the same in all images
// of a run.
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "base/geometry/angle.h"
#include "checks/run_checks.h"
#include "formats/files/json_vectors.h"

namespace throng::checks {

using nlohmann::json;

namespace {

constexpr double kVehicleRoundingM = 0.011;
constexpr double kVehicleRoundingRad = 0.006;

/// A contradiction within the record of a vehicle; "" without any.
std::string contradiction(const formats::Person& vehicle) {
  if (vehicle.velocity.norm() > 0) return "moves";
  const Eigen::Vector3d& size = vehicle.box_size;
  const Eigen::Vector3d foot = formats::numbers_at<3>(vehicle.record.at("position"));
  // Cars stand on the ground by their tires; the lowest parts of trains hang above it.
  constexpr double kMaxClearanceM = 0.35;
  constexpr double kSlackM = 2 * kVehicleRoundingM + 0.05;
  const double above_m = vehicle.box_middle.z() - size.z() / 2 - foot.z();
  const bool is_car = vehicle.track->value("vehicle", "") == "car";
  if (above_m < -kSlackM || above_m > (is_car ? 0 : kMaxClearanceM) + kSlackM) {
    return "has a box_3d that does not stand at the height of position";
  }
  const Eigen::Vector2d off = (vehicle.box_middle - foot).head<2>();
  if (off.norm() > 0.5 * size.head<2>().minCoeff()) return "has a box_3d beside position";
  const auto turn = formats::numbers_at<4>(vehicle.record.at("orientation_wxyz"));
  const double yaw_rad = 2 * std::atan2(turn[3], turn[0]);
  const double off_rad = std::remainder(yaw_rad - vehicle.heading_rad, 2 * EIGEN_PI);
  if (std::abs(off_rad) > kVehicleRoundingRad)
    return "has a heading that is not orientation_wxyz's";
  return "";
}

}  // namespace

void VehicleCheck::add(const formats::Image& image, Findings& findings) {
  for (const formats::Person& vehicle : image.objects) {
    if (!vehicle.track->contains("vehicle")) continue;
    const std::string wrong = contradiction(vehicle);
    if (!wrong.empty()) findings.add("vehicle", vehicle, "a vehicle " + wrong);
    json pose;
    for (const char* key : {"position", "heading", "box_3d", "orientation_wxyz", "category_id"}) {
      pose[key] = vehicle.record.at(key);
    }
    const auto [known, is_new] = poses_.try_emplace(vehicle.track_id, std::move(pose));
    if (is_new) continue;
    for (const auto& [key, value] : known->second.items()) {
      if (vehicle.record.at(key) == value) continue;
      findings.add("vehicle", vehicle,
                   fmt::format("{} {} of a vehicle that has {} in another image", key,
                               vehicle.record.at(key).dump(), value.dump()));
    }
  }
}

}  // namespace throng::checks
