// Operations on areas of ground with holes, by Boost.Geometry, and their division into the simple
// polygons of scenarios.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "places/imports/parts/corners.h"
#include "world/scenario.h"

namespace throng::imports {

/// An area with holes (m).
struct Area {
  Corners outline;
  std::vector<Corners> holes;
};

/// The area with corners in the right order, without repeated corners and corners on straight
/// edges. Nothing if it has no extent, crosses itself or has holes that are not within it.
std::optional<Area> tidied(const Area& area);

/// The result of tidied() if there is one; else the ground that the loops of the outline cover and
/// the loops of the holes do not (simple_loops()): the largest part first, without parts below 0.01
/// m².
std::vector<Area> repaired(const Area& area);

/// The parts of an area within a rectangle, and the parts outside of other areas.
std::vector<Area> clipped(const Area& area, const world::Rectangle& to);
std::vector<Area> without(const Area& area, const std::vector<Area>& others);

/// The ground within half of `width_m` of a line, with flat ends and mitered corners; empty if the
/// line has no length.
std::vector<Area> along(const std::vector<Eigen::Vector2d>& line, double width_m);

double size_m2(const Area& area);
double shared_m2(const Area& a, const Area& b);

/// Simple polygons that cover the area, which is cut through its holes. Omits pieces smaller than
/// `min_area_m2`.
std::vector<Corners> simple_parts(const Area& area, double min_area_m2 = 0.01);

/// The corners of a rectangle, and of a regular polygon with 24 corners that approximates a circle.
Corners rectangle_corners(const world::Rectangle& rectangle);
Corners circle(const Eigen::Vector2d& center, double radius_m);

}  // namespace throng::imports
