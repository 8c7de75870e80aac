// The look of a building: what its file says, and for the rest a choice by its number, so that
// neighbors differ. Independent of GL.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>

#include "world/building.h"

namespace throng::render {

using world::Paint;

/// A building's look with all choices made.
struct BuildingLook {
  world::Facade facade = world::Facade::plaster;  ///< not by_id
  Paint wall = Paint::Constant(0.5F);
  world::RoofKind roof = world::RoofKind::flat;  ///< not by_id
  double pitch_rad = 0;
  world::Covering covering = world::Covering::gravel;  ///< not by_id
  Paint roof_paint = Paint::Constant(0.3F);
  bool has_shops = false;  ///< on its ground floor
};

/// The look of building `number` of a scenario.
BuildingLook building_look(const world::Building& building, std::uint32_t number);

/// The color of front `front` of a building whose file names none: one of those of the facade, and
/// not that of the front before it.
Paint front_paint(world::Facade facade, std::uint32_t number, std::uint32_t front);

/// The unit vector along the longest wall.
Eigen::Vector2d main_direction(std::span<const Eigen::Vector2d> footprint);

/// How far a footprint reaches in a direction (m).
double extent_m(std::span<const Eigen::Vector2d> footprint, const Eigen::Vector2d& direction);

/// Whether a facade has stories with windows: no hedge, screen, blank or low wall.
bool has_stories(const world::Building& building);

}  // namespace throng::render
