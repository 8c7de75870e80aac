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
#include "render/scenery/railings.h"

namespace throng::render {

namespace {

constexpr double kGroundCellM = 2;       // cut where light varies (render/light/cut_meshes.h)
constexpr double kSurroundingsM = 3000;  // how far the plain goes

std::array<float, 3> three(double x, double y, double z) {
  return {static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)};
}

/// Grid lines over [low, high], one far away on each side, and at the ends of `holes`.
std::vector<double> grid_lines(double low, double high, int axis,
                               const std::vector<std::vector<Eigen::Vector2d>>& holes) {
  const int cells = std::clamp(static_cast<int>(std::ceil((high - low) / kGroundCellM)), 1, 128);
  std::vector<double> lines = {low - kSurroundingsM};
  for (int i = 0; i <= cells; ++i) lines.push_back(low + (high - low) * i / cells);
  lines.push_back(high + kSurroundingsM);
  for (const auto& hole : holes) {
    for (const Eigen::Vector2d& corner : hole) {
      lines.push_back(
          std::clamp(corner[axis], lines.front(), lines[static_cast<std::size_t>(cells) + 2]));
    }
  }
  std::sort(lines.begin(), lines.end());
  lines.erase(std::unique(lines.begin(), lines.end()), lines.end());
  return lines;
}

/// One grid for ground and plain, so that no gap opens between them, without the water.
class GroundGrid {
 public:
  GroundGrid(const world::Scenario& scenario, SceneryMesh& mesh)
      : scenario_(scenario),
        mesh_(mesh),
        holes_(world::water_parts(scenario.areas)),
        xs_(grid_lines(scenario.ground.min.x(), scenario.ground.max.x(), 0, holes_)),
        ys_(grid_lines(scenario.ground.min.y(), scenario.ground.max.y(), 1, holes_)),
        first_(static_cast<std::uint32_t>(mesh.vertices.size())) {
    for (const double y : ys_) {
      for (const double x : xs_) add_vertex({x, y});
    }
  }

  /// Adds the cells on the scenario's ground, or those beyond it.
  Range add_cells(bool inside) {
    const auto begin = static_cast<std::uint32_t>(mesh_.indices.size());
    for (std::size_t row = 0; row + 1 < ys_.size(); ++row) {
      for (std::size_t column = 0; column + 1 < xs_.size(); ++column) {
        const Eigen::Vector2d middle(0.5 * (xs_[column] + xs_[column + 1]),
                                     0.5 * (ys_[row] + ys_[row + 1]));
        if (scenario_.ground.contains(middle) == inside) add_cell(row, column);
      }
    }
    return {begin, static_cast<std::uint32_t>(mesh_.indices.size()) - begin};
  }

 private:
  std::uint32_t add_vertex(const Eigen::Vector2d& point) {
    mesh_.vertices.push_back(
        {three(point.x(), point.y(), 0), {0, 0, 1}, {ground_tone_at(point)}, kIdGround, 0, {}});
    return static_cast<std::uint32_t>(mesh_.vertices.size() - 1);
  }

  void add_cell(std::size_t row, std::size_t column) {
    if (!holes_.empty()) {
      const double x0 = xs_[column];
      const double x1 = xs_[column + 1];
      const double y0 = ys_[row];
      const double y1 = ys_[row + 1];
      const std::vector<Eigen::Vector2d> cell = {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
      const auto parts = world::without(cell, holes_);
      const bool is_whole = parts.size() == 1 && parts.front() == cell;
      if (!is_whole) {
        for (const auto& part : parts) add_fan(part);
        return;
      }
    }
    const auto corner = static_cast<std::uint32_t>(first_ + row * xs_.size() + column);
    const auto above = static_cast<std::uint32_t>(corner + xs_.size());
    mesh_.indices.insert(mesh_.indices.end(),
                         {corner, corner + 1, above + 1, corner, above + 1, above});
  }

  void add_fan(const std::vector<Eigen::Vector2d>& polygon) {
    std::vector<std::uint32_t> numbers;
    numbers.reserve(polygon.size());
    for (const Eigen::Vector2d& p : polygon) numbers.push_back(add_vertex(p));
    for (std::size_t i = 2; i < numbers.size(); ++i) {
      mesh_.indices.insert(mesh_.indices.end(), {numbers[0], numbers[i - 1], numbers[i]});
    }
  }

  const world::Scenario& scenario_;
  SceneryMesh& mesh_;
  std::vector<std::vector<Eigen::Vector2d>> holes_;
  std::vector<double> xs_;
  std::vector<double> ys_;
  std::uint32_t first_;
};

}  // namespace

SceneryMesh scenery_mesh(const world::Scenario& scenario) {
  SceneryMesh mesh;
  const auto indices = [&] { return static_cast<std::uint32_t>(mesh.indices.size()); };
  std::vector<BuildingModel> models;
  for (std::uint32_t i = 0; i < scenario.buildings.size(); ++i) {
    if (has_no_walls(scenario.buildings[i])) continue;
    models.push_back(building_model(without_leaves(scenario.buildings[i]), i));
  }
  for (const BuildingModel& model : models) add_walls(model, mesh);
  add_exit_doors(scenario, mesh);
  mesh.walls = {0, indices()};
  for (const BuildingModel& model : models) add_roof(model, mesh);
  mesh.roofs = {mesh.walls.count, indices() - mesh.walls.count};
  GroundGrid grid(scenario, mesh);
  mesh.ground = grid.add_cells(true);
  mesh.surroundings = grid.add_cells(false);
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
