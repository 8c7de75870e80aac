#include "render/scenery/scenery_details.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>

#include "base/compute/random.h"
#include "base/geometry/angle.h"
#include "base/geometry/polygon.h"
#include "base/geometry/rectangle.h"
#include "render/frame/frame.h"

namespace throng::render {

namespace {

using Eigen::Vector2d;

constexpr double kMinRoofM2 = 80;

/// A vertical rectangle, seen from the side that is to the right of its direction.
struct Panel {
  Vector2d from = Vector2d::Zero();
  Vector2d to = Vector2d::Zero();
  double foot_m = 0;
  double height_m = 0;
  std::uint32_t id = 0;
  WallLook look = WallLook::plant;
};

SceneryVertex make_vertex(const Eigen::Vector3d& p, const Eigen::Vector3d& normal,
                          const Eigen::Array4d& local, const Panel& panel) {
  return {{static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z())},
          {static_cast<float>(normal.x()), static_cast<float>(normal.y()),
           static_cast<float>(normal.z())},
          {static_cast<float>(local[0]), static_cast<float>(local[1]), static_cast<float>(local[2]),
           static_cast<float>(local[3])},
          panel.id,
          static_cast<float>(panel.look),
          {}};
}

void add_quad(const std::array<SceneryVertex, 4>& corners, SceneryMesh& mesh) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), corners.begin(), corners.end());
  mesh.indices.insert(mesh.indices.end(),
                      {first, first + 1, first + 2, first, first + 2, first + 3});
}

void add_panel(const Panel& panel, SceneryMesh& mesh) {
  const double length = (panel.to - panel.from).norm();
  const Vector2d along = (panel.to - panel.from) / length;
  const Eigen::Vector3d normal(along.y(), -along.x(), 0);
  const auto corner = [&](const Vector2d& p, double s, double up) {
    return make_vertex({p.x(), p.y(), panel.foot_m + up}, normal, {s, up, length, panel.height_m},
                       panel);
  };
  const double h = panel.height_m;
  add_quad({corner(panel.from, 0, 0), corner(panel.to, length, 0), corner(panel.to, length, h),
            corner(panel.from, 0, h)},
           mesh);
}

/// An upright box on a roof: half its sizes, height and middle.
struct Machine {
  Vector2d half = Vector2d::Zero();
  double height_m = 0;
  Vector2d middle = Vector2d::Zero();
};

void add_machine(const Machine& machine, const Vector2d& along, double roof_m, std::uint32_t id,
                 SceneryMesh& mesh) {
  const Vector2d across(-along.y(), along.x());
  const auto corners = geometry::turned_rectangle(machine.middle, machine.half, along);
  for (std::size_t i = 0; i < 4; ++i) {
    add_panel({corners[i], corners[(i + 1) % 4], roof_m, machine.height_m, id, WallLook::plant},
              mesh);
  }
  std::array<SceneryVertex, 4> top;
  Panel panel;
  panel.id = id;
  for (std::size_t i = 0; i < 4; ++i) {
    const Vector2d local = corners[i] - corners[0];
    top[i] = make_vertex(
        {corners[i].x(), corners[i].y(), roof_m + machine.height_m}, Eigen::Vector3d::UnitZ(),
        {local.dot(along), local.dot(across), 2 * machine.half.x(), 2 * machine.half.y()}, panel);
  }
  add_quad(top, mesh);
}

/// The direction of the longest wall.
Vector2d max_side(const std::vector<Vector2d>& footprint) {
  Vector2d longest = Vector2d::Zero();
  for (std::size_t i = 0; i < footprint.size(); ++i) {
    const Vector2d edge = footprint[(i + 1) % footprint.size()] - footprint[i];
    if (edge.norm() > longest.norm()) longest = edge;
  }
  return longest.normalized();
}

/// Half sizes and heights of what stands on a roof of this area, largest first.
std::vector<Machine> wanted_machines(double roof_m2, Random& random) {
  std::vector<Machine> wanted = {{{1.3, 1.0}, kRoofPlantM}};
  const int units = std::min(8, static_cast<int>(roof_m2 / 60));
  for (int i = 0; i < units; ++i) wanted.push_back({{0.8, 0.45}, random.uniform(0.8, 1.2)});
  for (int i = 0; i < units; ++i) wanted.push_back({{0.5, 0.5}, 0.3});
  for (int i = 0; i < 2 * units; ++i) wanted.push_back({{0.15, 0.15}, random.uniform(0.5, 1.0)});
  return wanted;
}

void add_machines(const world::Building& building, std::uint32_t number, SceneryMesh& mesh) {
  constexpr double kFromEdgeM = 0.7;
  constexpr double kApartM = 0.6;
  constexpr int kTries = 20;
  Random random(number, Stream::environment, 0x0F00F);
  Eigen::AlignedBox2d bounds;
  for (const Vector2d& corner : building.footprint) bounds.extend(corner);
  const Vector2d along = max_side(building.footprint);
  std::vector<Machine> placed;
  for (Machine& machine : wanted_machines(geometry::signed_area(building.footprint), random)) {
    const double reach = machine.half.norm();
    for (int attempt = 0; attempt < kTries; ++attempt) {
      machine.middle = {random.uniform(bounds.min().x(), bounds.max().x()),
                        random.uniform(bounds.min().y(), bounds.max().y())};
      if (geometry::signed_distance_to(building.footprint, machine.middle) > -reach - kFromEdgeM)
        continue;
      const bool is_free = std::all_of(placed.begin(), placed.end(), [&](const Machine& other) {
        return (other.middle - machine.middle).norm() > reach + other.half.norm() + kApartM;
      });
      if (!is_free) continue;
      add_machine(machine, along, building.height_m, kIdBuilding + number, mesh);
      placed.push_back(machine);
      break;
    }
  }
}

/// The part of a wall that an exit's door takes, if it lies in it.
std::optional<Panel> door_in(const world::Exit& exit, const Vector2d& from, const Vector2d& to) {
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
  return Panel{from + low * along + shift,
               from + high * along + shift,
               0,
               0,
               0,
               exit.open ? WallLook::open_door : WallLook::closed_door};
}

}  // namespace

bool has_roof_plant(const world::Building& building) {
  constexpr double kMinHeightM = 2.6;  // lower ones are walls, pedestals and the like
  return building.height_m >= kMinHeightM &&
         geometry::signed_area(building.footprint) >= kMinRoofM2;
}

void add_exit_doors(const world::Scenario& scenario, SceneryMesh& mesh) {
  constexpr double kDoorM = 2.5;
  for (std::uint32_t i = 0; i < scenario.buildings.size(); ++i) {
    const world::Building& building = scenario.buildings[i];
    for (std::size_t side = 0; side < building.footprint.size(); ++side) {
      const Vector2d& from = building.footprint[side];
      const Vector2d& to = building.footprint[(side + 1) % building.footprint.size()];
      for (const world::Exit& exit : scenario.exits) {
        std::optional<Panel> door = door_in(exit, from, to);
        if (!door) continue;
        door->height_m = std::min(kDoorM, building.height_m);
        door->id = kIdBuilding + i;
        add_panel(*door, mesh);
      }
    }
  }
}

void add_roof_plant(const world::Scenario& scenario, SceneryMesh& mesh) {
  for (std::uint32_t i = 0; i < scenario.buildings.size(); ++i) {
    if (has_roof_plant(scenario.buildings[i])) add_machines(scenario.buildings[i], i, mesh);
  }
}

}  // namespace throng::render
