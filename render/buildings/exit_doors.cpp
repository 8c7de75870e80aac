#include "render/buildings/exit_doors.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>

#include "base/geometry/angle.h"
#include "base/geometry/polygon.h"
#include "render/buildings/building_mesh.h"
#include "render/frame/frame.h"

namespace throng::render {

namespace {

using Eigen::Vector2d;

struct Doorway {
  Vector2d from = Vector2d::Zero();
  Vector2d to = Vector2d::Zero();
};

/// The part of a wall that an exit's door takes, if it lies in it.
std::optional<Doorway> door_in(const world::Exit& exit, const Vector2d& from, const Vector2d& to) {
  constexpr double kOffWallM = 0.5;
  constexpr double kInFrontM = 0.03;
  const double length = (to - from).norm();
  const Vector2d along = (to - from) / length;
  const Vector2d normal(along.y(), -along.x());
  const double skew = std::abs((exit.to - exit.from).normalized().dot(normal));
  const double off = std::abs((exit.middle() - from).dot(normal));
  if (skew > std::sin(3 * kDegree) || off > kOffWallM) return std::nullopt;
  double first = (exit.from - from).dot(along);
  double last = (exit.to - from).dot(along);
  if (first > last) std::swap(first, last);
  // A gap beside a building touches its corner only.
  constexpr double kMinShare = 0.9;
  const double low = std::max(first, 0.0);
  const double high = std::min(last, length);
  if (high - low < kMinShare * exit.width_m()) return std::nullopt;
  const Vector2d shift = kInFrontM * normal;
  return Doorway{from + low * along + shift, from + high * along + shift};
}

}  // namespace

void add_exit_doors(const world::Scenario& scenario, SceneryMesh& mesh) {
  constexpr double kDoorM = 2.5;
  for (std::uint32_t i = 0; i < scenario.buildings.size(); ++i) {
    const world::Building& building = scenario.buildings[i];
    for (std::size_t side = 0; side < building.footprint.size(); ++side) {
      const Vector2d& from = building.footprint[side];
      const Vector2d& to = building.footprint[(side + 1) % building.footprint.size()];
      for (const world::Exit& exit : scenario.exits) {
        const std::optional<Doorway> door = door_in(exit, from, to);
        if (!door) continue;
        add_wall_panel(door->from, door->to, std::min(kDoorM, building.height_m), kIdBuilding + i,
                       exit.open ? WallLook::open_door : WallLook::closed_door, mesh);
      }
    }
  }
}

bool is_near_exit(const world::Scenario& scenario, const Vector2d& point, double distance_m) {
  return std::any_of(scenario.exits.begin(), scenario.exits.end(), [&](const world::Exit& exit) {
    return geometry::distance_to_segment(exit.from, exit.to, point) < distance_m;
  });
}

}  // namespace throng::render
