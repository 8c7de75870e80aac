// The surfaces of a building's roof: slopes over the strips that its eaves sweep inwards
// (base/geometry/straight_skeleton.h), gables above its other walls. Independent of GL.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "render/buildings/building_look.h"

namespace throng::render {

enum class RoofPart : std::uint8_t {
  covering,  ///< a slope, or the surface of a flat roof
  gable,     ///< upright, of the material of the wall below
  glazing,   ///< upright, of glass
  coping     ///< the top of a parapet
};

/// A plane surface with three or four corners, counter-clockwise from outside.
struct RoofSurface {
  RoofPart part = RoofPart::covering;
  std::vector<Eigen::Vector3d> corners;
  /// The wall below: its first corner and direction, from which lengths along it count.
  Eigen::Vector2d from = Eigen::Vector2d::Zero();
  Eigen::Vector2d along = Eigen::Vector2d::UnitX();
  std::size_t wall = 0;
};

struct RoofShape {
  double eaves_m = 0;  ///< to which the walls reach
  double top_m = 0;    ///< of the surface of a flat roof, or the ridge
  bool is_flat = true;
  std::vector<RoofSurface> surfaces;
  std::vector<std::size_t> eaves;  ///< walls above which a slope begins, with gutters
};

/// The roof of a building. One whose shape cannot be that of its footprint is hipped, or else flat.
RoofShape roof_shape(const world::Building& building, const BuildingLook& look);

}  // namespace throng::render
