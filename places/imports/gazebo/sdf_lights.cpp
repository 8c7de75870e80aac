#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "base/geometry/angle.h"
#include "places/imports/gazebo/camera_sensor.h"
#include "places/imports/gazebo/sdf_reader.h"
#include "places/imports/gazebo/world_fixtures.h"
#include "places/imports/gazebo/world_sun.h"

namespace throng::imports {

using Eigen::Isometry3d;
using Eigen::Vector3d;

std::optional<Isometry3d> SdfReader::light_pose(const sdf::Light& light, const Isometry3d& parent,
                                                const std::string& name) {
  const auto saved = state_.lights.find(light.Name());
  if (name == "world/" + light.Name() && saved != state_.lights.end() && saved->second.pose) {
    return saved->second.pose;
  }
  return resolve(light.SemanticPose(), parent, light.Element(), name);
}

/// The first directional light becomes the sun of the draft job.
void SdfReader::add_sun(const sdf::Light& light, const Isometry3d& parent,
                        const std::string& name) {
  if (!place_.environment.is_null()) {
    return skip(light.Element(), name, "another directional light than the first, the sun");
  }
  const auto pose = light_pose(light, parent, name);
  if (!pose) return;
  const ignition::math::Vector3d shines = light.Direction();
  const Vector3d towards_light = pose->linear() * Vector3d(-shines.X(), -shines.Y(), -shines.Z());
  const auto sun = sun_like(towards_light, latitude_deg_);
  if (!sun) return skip(light.Element(), name, "shines from below 3 degrees, as no sun by day");
  const auto minutes = static_cast<int>(std::lround(60 * sun->time_of_day_h));
  place_.environment = {{"latitude_deg", sun->latitude_deg},
                        {"day_of_year", sun->day_of_year},
                        {"time_of_day", fmt::format("{:02}:{:02}", minutes / 60, minutes % 60)}};
  constexpr double kNear = 2 * kDegree;
  if (sun->error_rad <= kNear) return;
  skip(light.Element(), name,
       fmt::format("the sun of the job stands {:.0f} degrees beside it, as near as at a latitude "
                   "of {:g} degrees",
                   sun->error_rad / kDegree, sun->latitude_deg));
}

void SdfReader::add_sensor(const sdf::Sensor& sensor, const Isometry3d& link,
                           const std::string& path) {
  const std::string name = fmt::format("{}/{} <sensor>", path, sensor.Name());
  if (!is_camera(sensor)) {
    return skip(sensor.Element(), name,
                fmt::format("a scenario has no sensor of the type {}", sensor.TypeStr()));
  }
  if (const auto why = add_camera(sensor, link, place_)) return skip(sensor.Element(), name, *why);
  reach({place_.drones.back().position.head<2>()});
}

void SdfReader::add_light(const sdf::Light& light, const Isometry3d& parent,
                          const std::string& path) {
  const std::string name = path + "/" + light.Name();
  if (light.Type() == sdf::LightType::DIRECTIONAL) return add_sun(light, parent, name);
  const auto pose = light_pose(light, parent, name);
  if (!pose) return;
  constexpr double kLampM = 4.6;  // of a prop of scale 1
  const double height = pose->translation().z();
  if (!(height >= 2 && height <= 12)) {
    return skip(light.Element(), name, "only lamps 2 to 12 m above the ground become lamp posts");
  }
  world::Prop lamp;
  lamp.kind = world::PropKind::lamp_post;
  lamp.position = pose->translation().head<2>();
  lamp.scale = height / kLampM;
  place_.props.push_back(lamp);
}

}  // namespace throng::imports
