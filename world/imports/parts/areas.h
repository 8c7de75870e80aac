// Areas on the ground while they are worked on: an outline with holes, checked and cut by
// Boost.Geometry, and at last taken apart into the simple polygons that scenarios are made of.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "world/scenario.h"

namespace throng::imports {

/// Corners in order, counter-clockwise seen from above, not repeated at the end (m).
using Corners = std::vector<Eigen::Vector2d>;

struct Area {
  Corners outline;
  std::vector<Corners> holes;
};

/// The area with corners in the right order and without those that repeat or lie on a straight
/// edge; nothing where it has no extent, crosses itself or has holes that do not lie within it.
std::optional<Area> tidied(const Area& area);

/// The area as it is if tidied() takes it; else what the loops of its outline cover and those of
/// its holes do not (simple_loops()), the largest part first, those of less than 0.01 m² left out.
std::vector<Area> repaired(const Area& area);

/// The parts of an area in a rectangle, and outside of others.
std::vector<Area> clipped(const Area& area, const world::Rectangle& to);
std::vector<Area> without(const Area& area, const std::vector<Area>& others);

/// The ground within half of `width_m` of a line, with flat ends and corners cut square; empty
/// where the line has no length.
std::vector<Area> along(const std::vector<Eigen::Vector2d>& line, double width_m);

double size_m2(const Area& area);
double shared_m2(const Area& a, const Area& b);

/// Simple polygons that cover the area: where there are holes it is cut through them. Pieces
/// smaller than `min_area_m2` are left out.
std::vector<Corners> simple_parts(const Area& area, double min_area_m2 = 0.01);

/// A rectangle's corners; a regular polygon of 24 corners in place of a circle.
Corners rectangle_corners(const world::Rectangle& rectangle);
Corners circle(const Eigen::Vector2d& center, double radius_m);

}  // namespace throng::imports
