// A walled rectangle with gates, the basis of every generated scenario.
#pragma once

#include <Eigen/Core>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "base/compute/random.h"
#include "world/scenario.h"

namespace throng::scenarios {

/// Sides of a rectangle.
enum class Side { south, east, north, west };

/// A gap in a frame's wall; `middle_m` is measured along the side from the frame's min corner.
struct Gate {
  Side side = Side::south;
  double middle_m = 0;
  double width_m = 4;
};

/// The open rectangle in the center of a scenario (m); its walls stand outside of it.
struct Frame {
  Eigen::Vector2d min = Eigen::Vector2d::Zero();
  Eigen::Vector2d max = Eigen::Vector2d::Zero();
  double depth_m = 10;  ///< depth of the buildings around it
  std::vector<Gate> gates;

  Eigen::Vector2d size() const { return max - min; }
  double length_of(Side side) const {
    return side == Side::south || side == Side::north ? size().x() : size().y();
  }
};

/// The style of a frame's walls.
struct WallStyle {
  double density = 0.5;     ///< share of houses among the pieces; the others are garden walls
  double min_height_m = 6;  ///< min height of houses
  double max_height_m = 18;
};

/// Places up to `count` gates on the sides, at least their width from each other and from corners,
/// as far as there is room; at least one per side in `sides`.
std::vector<Gate> spread_gates(const Frame& frame, const std::vector<Side>& sides, int count,
                               double width_m, Random& random);

/// A rectangle as JSON: [[x, y], ...] counter-clockwise.
nlohmann::json outline_json(const Eigen::Vector2d& min, const Eigen::Vector2d& max);
nlohmann::json point_json(const Eigen::Vector2d& point);

/// Adds a rectangle of another material to a blueprint's ground, with or without kerb stones.
void add_area(const Eigen::Vector2d& min, const Eigen::Vector2d& max, const char* material,
              bool kerb, nlohmann::json& blueprint);

/// A house or hall as an element of a blueprint's "buildings".
nlohmann::json house_json(const std::string& id, const Eigen::Vector2d& min,
                          const Eigen::Vector2d& max, double height_m, Random& random);

/// The ends of a gate on a frame's inner side (m).
std::pair<Eigen::Vector2d, Eigen::Vector2d> gate_ends(const Frame& frame, const Gate& gate);

/// Adds the frame's walls to "buildings" and its gates to "exits" of a blueprint.
void build_walls(const Frame& frame, const WallStyle& style, Random& random,
                 nlohmann::json& blueprint);

}  // namespace throng::scenarios
