// Shapes of houses and trees that are seen from 50 m and more, with few triangles.
#pragma once

#include <Eigen/Core>

#include "render/props/prop_builder.h"

namespace throng::render {

/// How much of an object is drawn; by its distance from the place.
enum class FarDetail : std::uint8_t { near, middle, far };

/// A house: its middle on the ground, the directions of its sides, and sizes (m).
struct FarHouse {
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  double yaw_rad = 0;
  Eigen::Vector2d half_size{6, 4.5};  ///< the ridge runs along x
  int stories = 2;
  bool has_flat_roof = false;
  FarDetail detail = FarDetail::near;
};

struct FarTree {
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  double height_m = 9;
  double crown_m = 3;  ///< radius
  FarDetail detail = FarDetail::near;
};

/// Adds a house with walls, rows of windows, a roof, and a dark rim of ground; its colors are drawn
/// from `random`.
void add_far_house(PropBuilder& builder, const FarHouse& house, Random& random);

/// Adds a tree of 2 to 9 large cards.
void add_far_tree(PropBuilder& builder, const FarTree& tree, Random& random);

}  // namespace throng::render
