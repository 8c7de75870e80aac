// Ground areas with a material of their own, and painted markings.
#pragma once

#include <Eigen/Core>
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

}  // namespace throng::world
