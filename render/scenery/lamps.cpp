#include "render/scenery/lamps.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "render/ground/scenery_mesh.h"
#include "render/props/shape_file.h"
#include "render/scenery/railings.h"

namespace throng::render {

namespace {

constexpr double kHeightM = 4.2;
constexpr double kSpacingM = 12;
constexpr double kMinWallM = 4;
// About 1000 candela over 54 000 lux: 57 lux on the ground below a lamp 4.2 m up.
constexpr double kStrengthM2 = 1000.0 / 54'000;

void add_prop_lamps(const world::Prop& prop, std::vector<Lamp>& lamps) {
  for (const ShapeLamp& lamp : shape_lamps(world::prop_type(prop.kind).name)) {
    const Eigen::Vector2d at =
        prop.position + prop.scale * (Eigen::Rotation2Dd(prop.yaw_rad) * lamp.position.head<2>());
    lamps.push_back(
        {{at.x(), at.y(), prop.scale * lamp.position.z()}, {0, 0}, lamp.strength, lamp.color});
  }
}

}  // namespace

std::vector<Lamp> wall_lamps(const world::Scenario& scenario) {
  constexpr double kOffWallM = 0.35;
  std::vector<Lamp> lamps;
  for (const world::Building& building : scenario.buildings) {
    if (building.height_m < kMinStoryM || has_no_walls(building)) continue;
    const std::vector<Eigen::Vector2d>& corners = building.footprint;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Eigen::Vector2d& from = corners[i];
      const Eigen::Vector2d edge = corners[(i + 1) % corners.size()] - from;
      const double length = edge.norm();
      if (length < kMinWallM) continue;
      const Eigen::Vector2d out = Eigen::Vector2d(edge.y(), -edge.x()) / length;
      const int count = std::max(1, static_cast<int>(length / kSpacingM));
      for (int k = 0; k < count; ++k) {
        const Eigen::Vector2d at = from + edge * ((k + 0.5) / count) + kOffWallM * out;
        lamps.push_back({{at.x(), at.y(), std::min(kHeightM, 0.8 * building.height_m)}, out});
      }
    }
  }
  return lamps;
}

std::vector<Lamp> all_lamps(const world::Scenario& scenario) {
  std::vector<Lamp> lamps = wall_lamps(scenario);
  for (const world::Prop& prop : scenario.props) add_prop_lamps(prop, lamps);
  return lamps;
}

double lamp_reach_m(const Lamp& lamp) {
  constexpr double kReachM = 26;
  constexpr double kStrong = 1.5;
  constexpr double kMaxFactor = 4;
  return kReachM * std::clamp(std::sqrt(lamp.strength / kStrong), 1.0, kMaxFactor);
}

double lamp_strength(const Lamp& lamp, double distance_m, double up) {
  // Street lamps throw their light wide, and little of it above the horizontal.
  constexpr double kUpwards = 0.1;
  const double down = std::max(std::sqrt(std::max(up, 0.0)), kUpwards);
  const double rim = 1 - std::pow(distance_m / lamp_reach_m(lamp), 4);
  // A lamp is no point: what hangs on its wall is not lit without limit.
  constexpr double kSizeM = 0.7;
  return lamp.strength * kStrengthM2 * down * rim * rim /
         (distance_m * distance_m + kSizeM * kSizeM);
}

}  // namespace throng::render
