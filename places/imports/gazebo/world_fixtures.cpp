#include "places/imports/gazebo/world_fixtures.h"

#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <sdf/sdf.hh>
#include <utility>
#include <vector>

#include "base/geometry/angle.h"
#include "base/geometry/polygon.h"
#include "places/imports/gazebo/camera_json.h"
#include "places/imports/gazebo/camera_sensor.h"
#include "places/imports/gazebo/motor_plugin.h"
#include "places/imports/parts/scenario_writer.h"
#include "places/imports/sdf/sdf_root.h"

namespace throng::imports {

using Eigen::Vector3d;

namespace {

constexpr double kMinRobotHeightM = 2;  // below it a robot stands on something

/// A name for jobs, unlike those of the other drones and of the overview.
std::string drone_id(const std::string& name, const ImportedScenario& place) {
  std::string id = name;
  for (char& c : id) {
    if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '_' && c != '-') c = '_';
  }
  if (id.empty()) id = "drone";
  const auto is_taken = [&](const std::string& candidate) {
    return candidate == "d1" || std::any_of(place.drones.begin(), place.drones.end(),
                                            [&](auto& drone) { return drone.id == candidate; });
  };
  std::string unique = id;
  for (int i = 2; is_taken(unique); ++i) unique = fmt::format("{}_{}", id, i);
  return unique;
}

double heading_rad(const Eigen::Isometry3d& pose) {
  const Vector3d ahead = pose.linear().col(0);
  return std::atan2(ahead.y(), ahead.x());
}

bool has_motor(const sdf::ElementPtr& element) {
  if (!element || !element->HasElement("plugin")) return false;
  for (auto plugin = element->GetElement("plugin"); plugin;
       plugin = plugin->GetNextElement("plugin")) {
    if (is_motor(plugin) || is_hector_propulsion(plugin)) return true;
  }
  return false;
}

bool is_near_building(const Vector3d& position, const ImportedScenario& place) {
  constexpr double kClearanceM = 1;  // drones keep half a meter, also while they sway
  return std::any_of(place.buildings.begin(), place.buildings.end(), [&](auto& building) {
    return position.z() < building.height_m + kClearanceM &&
           geometry::distance_to(building.footprint, position.head<2>()) < kClearanceM;
  });
}

}  // namespace

bool is_robot(const sdf::Model& model) {
  if (has_motor(model.Element())) return true;
  for (std::uint64_t i = 0; i < model.ModelCount(); ++i) {
    if (is_robot(*model.ModelByIndex(i))) return true;
  }
  return false;
}

void add_robot(const sdf::Model& model, const Eigen::Isometry3d& pose, ImportedScenario& place) {
  ImportedDrone drone;
  drone.id = drone_id(model.Name(), place);
  drone.position = pose.translation();
  drone.yaw_rad = heading_rad(pose);
  const std::string file = model.Element() ? model.Element()->FilePath() : "";
  if (!is_given_text(file)) drone.robot_file = file;
  place.drones.push_back(std::move(drone));
}

std::optional<std::string> add_camera(const sdf::Sensor& sensor, const Eigen::Isometry3d& link,
                                      ImportedScenario& place) {
  auto camera = read_camera_sensor(sensor, link);
  if (!camera) return "it has no <camera>, or a pose relative to a frame that does not exist";
  ImportedDrone drone;
  drone.id = drone_id(sensor.Name(), place);
  drone.position = camera->pose.translation();
  drone.yaw_rad = heading_rad(camera->pose);
  camera->is_movable = true;  // the hovering drone's gimbal keeps it still
  std::vector<std::string> unsaid;
  drone.camera = camera_json(*camera, drone.position, unsaid);
  drone.camera["yaw_deg"] = 0;
  drone.camera.erase("mount");
  if (auto why = camera_refusal(drone.camera)) return why;
  place.drones.push_back(std::move(drone));
  return std::nullopt;
}

void place_drones(const std::string& file, ImportedScenario& place) {
  for (ImportedDrone& drone : place.drones) {
    const bool is_robot_on_ground = drone.camera.is_null() && drone.position.z() < kMinRobotHeightM;
    if (!is_robot_on_ground) continue;
    const double height_m = overview_height_m(place);
    place.skipped.push_back({file, 0, "robot " + drone.id,
                             fmt::format("stands at {:.2f} m; its drone begins {:.0f} m up",
                                         drone.position.z(), height_m)});
    drone.position.z() = height_m;
  }
  std::erase_if(place.drones, [&](const ImportedDrone& drone) {
    constexpr double kLowestM = 0.5;
    if (drone.position.z() >= kLowestM && !is_near_building(drone.position, place)) return false;
    place.skipped.push_back({file, 0, "camera " + drone.id,
                             "less than 1 m from a building or from the ground, where no drone "
                             "hovers"});
    return true;
  });
}

}  // namespace throng::imports
