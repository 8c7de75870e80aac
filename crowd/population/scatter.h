// People placed at random in an area, as a crowd stands before it moves (random sequential
// addition).
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "base/compute/random.h"
#include "crowd/spatial/obstacles.h"

namespace throng::crowd {

struct ScatterSpec {
  std::vector<Eigen::Vector2f> area;  ///< corners of a polygon, m
  std::size_t count = 1;
  float apart_m = 0.5F;      ///< at least, between the middles of any two people
  float clearance_m = 0.3F;  ///< at least, between a middle and a wall
  std::uint32_t obstacle_mask = std::numeric_limits<std::uint32_t>::max();  ///< walls that count
};

/// Places at random, evenly over the free part of the area and as far from each other and from
/// those `taken` as the spec says: random sequential addition (Feder 1980), which fills an area
/// with discs of diameter `apart_m` up to a share of 0.547. Fewer places than asked for where a
/// long series of draws finds no room. Neighbors follow each other. The walls have to be built.
std::vector<Eigen::Vector2f> scatter(const ScatterSpec& spec, const Obstacles& walls,
                                     std::span<const Eigen::Vector2f> taken, Random random);

}  // namespace throng::crowd
