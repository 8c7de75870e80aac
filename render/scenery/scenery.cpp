#include "render/scenery/scenery.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/compute/random.h"
#include "base/geometry/polygon.h"
#include "base/geometry/triangulate.h"
#include "render/frame/frame.h"
#include "render/ground/ground_tone.h"
#include "render/scenery/hedges.h"
#include "render/scenery/scenery_details.h"

namespace throng::render {

namespace {

constexpr double kGroundCellM = 2;       // cut where light varies (render/light/cut_meshes.h)
constexpr double kSurroundingsM = 3000;  // how far the plain goes

std::array<float, 3> three(double x, double y, double z) {
  return {static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)};
}

/// Grid lines over [low, high], and one far away on each side.
std::vector<double> grid_lines(double low, double high) {
  const int cells = std::clamp(static_cast<int>(std::ceil((high - low) / kGroundCellM)), 1, 128);
  std::vector<double> lines = {low - kSurroundingsM};
  for (int i = 0; i <= cells; ++i) lines.push_back(low + (high - low) * i / cells);
  lines.push_back(high + kSurroundingsM);
  return lines;
}

/// One grid for ground and plain, so that no gap opens between them.
void add_ground(const world::Scenario& scenario, SceneryMesh& mesh) {
  const std::vector<double> xs = grid_lines(scenario.ground.min.x(), scenario.ground.max.x());
  const std::vector<double> ys = grid_lines(scenario.ground.min.y(), scenario.ground.max.y());
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (const double y : ys) {
    for (const double x : xs) {
      mesh.vertices.push_back(
          {three(x, y, 0), {0, 0, 1}, {ground_tone_at({x, y})}, kIdGround, 0, {}});
    }
  }
  const auto add_cells = [&](bool inside) {
    const Range range = {static_cast<std::uint32_t>(mesh.indices.size()), 0};
    for (std::size_t row = 0; row + 1 < ys.size(); ++row) {
      for (std::size_t column = 0; column + 1 < xs.size(); ++column) {
        const bool edge =
            row == 0 || column == 0 || row + 2 == ys.size() || column + 2 == xs.size();
        if (edge == inside) continue;
        const auto corner = static_cast<std::uint32_t>(first + row * xs.size() + column);
        const auto above = static_cast<std::uint32_t>(corner + xs.size());
        mesh.indices.insert(mesh.indices.end(),
                            {corner, corner + 1, above + 1, corner, above + 1, above});
      }
    }
    return Range{range.first, static_cast<std::uint32_t>(mesh.indices.size()) - range.first};
  };
  mesh.ground = add_cells(true);
  mesh.surroundings = add_cells(false);
}

void add_walls(const world::Building& building, std::uint32_t id, SceneryMesh& mesh) {
  const double height = building.height_m;
  for (std::size_t i = 0; i < building.footprint.size(); ++i) {
    const Eigen::Vector2d& from = building.footprint[i];
    const Eigen::Vector2d& to = building.footprint[(i + 1) % building.footprint.size()];
    const double length = (to - from).norm();
    const Eigen::Vector2d along = (to - from) / length;
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (const double z : {0.0, height}) {
      for (const double s : {0.0, length}) {
        const Eigen::Vector2d p = s == 0.0 ? from : to;
        mesh.vertices.push_back({three(p.x(), p.y(), z),
                                 three(along.y(), -along.x(), 0),
                                 {static_cast<float>(s), static_cast<float>(z),
                                  static_cast<float>(length), static_cast<float>(height)},
                                 id,
                                 static_cast<float>(building.facade),
                                 {}});
      }
    }
    mesh.indices.insert(mesh.indices.end(),
                        {first, first + 1, first + 3, first, first + 3, first + 2});
  }
}

void add_roof(const world::Building& building, std::uint32_t id, SceneryMesh& mesh) {
  Eigen::AlignedBox2d bounds;
  for (const Eigen::Vector2d& corner : building.footprint) bounds.extend(corner);
  const Eigen::Vector2d size = bounds.sizes();
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (const Eigen::Vector2d& corner : building.footprint) {
    const Eigen::Vector2d local = corner - bounds.min();
    mesh.vertices.push_back({three(corner.x(), corner.y(), building.height_m),
                             {0, 0, 1},
                             {static_cast<float>(local.x()), static_cast<float>(local.y()),
                              static_cast<float>(size.x()), static_cast<float>(size.y())},
                             id,
                             static_cast<float>(building.facade),
                             {}});
  }
  for (const auto& triangle : geometry::triangulate(building.footprint)) {
    for (const std::uint32_t corner : triangle) mesh.indices.push_back(first + corner);
  }
}

}  // namespace

SceneryMesh scenery_mesh(const world::Scenario& scenario) {
  SceneryMesh mesh;
  const auto indices = [&] { return static_cast<std::uint32_t>(mesh.indices.size()); };
  for (std::uint32_t i = 0; i < scenario.buildings.size(); ++i) {
    add_walls(without_leaves(scenario.buildings[i]), kIdBuilding + i, mesh);
  }
  add_exit_doors(scenario, mesh);
  add_roof_plant(scenario, mesh);
  mesh.walls = {0, indices()};
  for (std::uint32_t i = 0; i < scenario.buildings.size(); ++i) {
    add_roof(without_leaves(scenario.buildings[i]), kIdBuilding + i, mesh);
  }
  mesh.roofs = {mesh.walls.count, indices() - mesh.walls.count};
  add_ground(scenario, mesh);
  return mesh;
}

double tallest_m(const world::Scenario& scenario) {
  double tallest = 2.5;
  constexpr double kTreeM = 8.4;
  constexpr double kMeshM = 30;  // higher parts of meshes throw no shadow
  if (!scenario.meshes.empty()) tallest = kMeshM;
  for (const world::Prop& prop : scenario.props) tallest = std::max(tallest, kTreeM * prop.scale);
  for (const world::Building& building : scenario.buildings) {
    const double plant_m = has_roof_plant(building) ? kRoofPlantM : 0;
    tallest = std::max(tallest, building.height_m + plant_m);
  }
  return tallest;
}

}  // namespace throng::render
