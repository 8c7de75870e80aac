#include "render/scenery/scenery.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/compute/random.h"
#include "render/buildings/building_mesh.h"
#include "render/buildings/exit_doors.h"
#include "render/buildings/roof_details.h"
#include "render/frame/frame.h"
#include "render/ground/ground_tone.h"
#include "render/scenery/hedges.h"

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

}  // namespace

SceneryMesh scenery_mesh(const world::Scenario& scenario) {
  SceneryMesh mesh;
  const auto indices = [&] { return static_cast<std::uint32_t>(mesh.indices.size()); };
  std::vector<BuildingModel> models;
  for (std::uint32_t i = 0; i < scenario.buildings.size(); ++i) {
    models.push_back(building_model(without_leaves(scenario.buildings[i]), i));
  }
  for (const BuildingModel& model : models) add_walls(model, mesh);
  add_exit_doors(scenario, mesh);
  mesh.walls = {0, indices()};
  for (const BuildingModel& model : models) add_roof(model, mesh);
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
    tallest = std::max(tallest, building.height_m + kMaxAboveRoofM);
  }
  return tallest;
}

}  // namespace throng::render
