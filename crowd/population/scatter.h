// Random start positions of people in an area (random sequential addition).
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "base/compute/random.h"
#include "crowd/spatial/obstacles.h"

namespace throng::crowd {

/// Area, number and distances of people to place.
struct ScatterSpec {
  std::vector<Eigen::Vector2f> area;  ///< corners of a polygon, m
  std::size_t count = 1;
  float apart_m = 0.5F;      ///< min distance between the centers of two people
  float clearance_m = 0.3F;  ///< min distance between a center and a wall
  /// Classes of walls to avoid.
  std::uint32_t obstacle_mask = std::numeric_limits<std::uint32_t>::max();
};

/// Returns random positions, uniform over the free part of the area, that keep the distances of
/// `spec` to each other, to `taken` and to the walls. Random sequential addition (Feder 1980)
/// covers up to a share of 0.547 of an area with discs of diameter `apart_m`. Returns fewer than
/// `spec.count` positions after 5000 samples in a row without a free position. Positions are sorted
/// so that near ones follow each other. Obstacles::build() must have been called.
std::vector<Eigen::Vector2f> scatter(const ScatterSpec& spec, const Obstacles& walls,
                                     std::span<const Eigen::Vector2f> taken, Random random);

}  // namespace throng::crowd
