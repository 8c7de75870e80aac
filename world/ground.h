// Ground areas of other materials than the scenario's main one, and painted markings.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace throng::world {

class JsonValue;

/// A polygon of another material. Corners counter-clockwise seen from above.
struct GroundArea {
  std::vector<Eigen::Vector2d> corners;  ///< m
  std::string material;
  bool kerb = false;  ///< edged with kerb stones
};

/// A strip of paint from one point to another: a line, a dashed line, or the bars of a zebra
/// crossing, which lie along the strip's direction of travel (from -> to crosses the road).
struct Marking {
  std::string kind;                                ///< "line", "dashes", "crossing"
  Eigen::Vector2d from = Eigen::Vector2d::Zero();  ///< m
  Eigen::Vector2d to = Eigen::Vector2d::Zero();    ///< m
  double width_m = 0.12;
};

/// "pavers", "asphalt", "grass", "concrete" or "dirt"; anything else is a problem.
std::string read_ground_material(const JsonValue& value);

std::vector<GroundArea> read_ground_areas(const JsonValue& list);
std::vector<Marking> read_markings(const JsonValue& list);

}  // namespace throng::world
