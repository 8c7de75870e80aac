// Walls and roofs of buildings as triangles. Independent of GL.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "render/buildings/building_look.h"
#include "render/buildings/roof_shape.h"
#include "render/ground/scenery_mesh.h"
#include "world/building.h"

namespace throng::render {

/// Values of SceneryVertex::facade in addition to world::Facade; also in shaders/wall.frag.glsl.
enum class WallLook : std::uint8_t {
  open_door = 4,
  closed_door = 5,
  gable = 6,        ///< plaster without windows
  brick_gable = 7,  ///< brick without windows
  glazing = 14      ///< rows of panes
};

/// Values of SceneryVertex::facade of roofs in addition to world::Covering; also in
/// shaders/roof.frag.glsl.
enum class RoofLook : std::uint8_t { coping = 7, hedge = 8, wall_top = 9 };

/// A part of a wall that looks like a house of its own.
struct Front {
  Eigen::Vector2d from = Eigen::Vector2d::Zero();  ///< m
  Eigen::Vector2d along = Eigen::Vector2d::UnitX();
  double length_m = 0;
  double height_m = 0;
  Paint paint = Paint::Zero();
  std::uint8_t number = 0;  ///< within its building, 0 to 127
};

/// A building with all that is drawn of it but its details.
struct BuildingModel {
  world::Building building;
  std::uint32_t number = 0;  ///< in the scenario
  BuildingLook look;
  RoofShape roof;
  std::vector<Front> fronts;
};

BuildingModel building_model(const world::Building& building, std::uint32_t number);

void add_walls(const BuildingModel& model, SceneryMesh& mesh);
void add_roof(const BuildingModel& model, SceneryMesh& mesh);

/// Adds an upright rectangle on the ground, seen from the right of its direction.
void add_wall_panel(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double height_m,
                    std::uint32_t id, WallLook look, SceneryMesh& mesh);

}  // namespace throng::render
