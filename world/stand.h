// Stands: tiers of seats for spectators, in straight rows; and the decks of stages.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "world/building.h"

namespace throng::world {

/// Spectators of a stand, on seats that a seed chooses.
struct Spectators {
  int count = 0;
  std::uint64_t seed = 0;
  /// When they begin to leave (s); they walk down the aisles to the ground before the stand.
  double leave_at_s = std::numeric_limits<double>::infinity();
};

/// Rows of seats that rise away from a field.
struct Stand {
  std::string id;
  Eigen::Vector2d from = Eigen::Vector2d::Zero();  ///< front edge, the field on its left (m)
  Eigen::Vector2d to = Eigen::Vector2d::Zero();    ///< m
  int rows = 20;
  double front_height_m = 1;  ///< of the first row's floor
  double row_depth_m = 0.85;
  double row_rise_m = 0.38;
  bool roof = false;          ///< cantilevered over all rows
  int vomitories = 0;         ///< openings through which people come from below, evenly spaced
  std::vector<Paint> colors;  ///< of the seats, the first of most; empty: blue with white
  std::string text;           ///< written with seats of the last color
  Spectators spectators;
  /// A stage's deck has the places of its band instead of rows, with the height of their floor (m).
  std::vector<Eigen::Vector3d> band = {};
};

}  // namespace throng::world
