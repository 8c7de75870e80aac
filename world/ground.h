// Ground areas with a material of their own, and painted markings.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <limits>
#include <span>
#include <string>
#include <vector>

namespace throng::world {

/// A polygon with a material of its own. Corners counter-clockwise seen from above.
struct GroundArea {
  std::vector<Eigen::Vector2d> corners;  ///< m
  std::string material;
  bool kerb = false;  ///< bordered by kerb stones
  /// Height of the surface of water, whose banks are walls (m); areas above it are bridges.
  double level_m = 0;
};

/// A strip from one point to another: a line, a dashed line, or the bars of a zebra crossing, which
/// lie along the strip's direction of travel (from -> to crosses the road); a pitch between the
/// middles of its goal lines, or a track of a railway.
struct Marking {
  std::string kind;  ///< "line", "dashes", "crossing", "pitch", "track"
  Eigen::Vector2d from = Eigen::Vector2d::Zero();  ///< m
  Eigen::Vector2d to = Eigen::Vector2d::Zero();    ///< m
  double width_m = 0.12;
};

/// Convex parts, counter-clockwise, of the water areas that come after the area with this index;
/// with none, of all.
std::vector<std::vector<Eigen::Vector2d>> water_parts(
    std::span<const GroundArea> areas, std::size_t after = std::numeric_limits<std::size_t>::max());

/// Convex parts, counter-clockwise, of the water that no bridge covers.
std::vector<std::vector<Eigen::Vector2d>> open_water(std::span<const GroundArea> areas);

/// The parts of a convex polygon that lie in none of these convex ones.
std::vector<std::vector<Eigen::Vector2d>> without(
    const std::vector<Eigen::Vector2d>& polygon,
    const std::vector<std::vector<Eigen::Vector2d>>& holes);

/// Height of what shows at a point: that of the water, or 0, also on bridges (m).
double surface_level_m(std::span<const GroundArea> areas, const Eigen::Vector2d& point);

}  // namespace throng::world
