// Worked edges and patterns of the ground: kerbs, gutters, bands of setts, tactile paving and
// paint.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "render/ground/ground_builder.h"
#include "render/ground/ground_map.h"
#include "world/scenario.h"

namespace throng::render {

/// Kerb stones: a raised edge around lawns and beds with `kerb`, and flat stones along roads, since
/// people walk on one level.
void add_kerbs(const world::Scenario& scenario, const GroundMap& map, GroundBuilder& builder);

/// Two rows of setts inside of the kerbs of roads.
void add_gutters(const GroundMap& map, GroundBuilder& builder);

/// The outline of an area, what is cut out of it (convex, counter-clockwise), and its height.
struct GroundCover {
  std::vector<Eigen::Vector2d> corners;
  std::vector<std::vector<Eigen::Vector2d>> holes;
  double height_m = 0;
};

/// Bands of setts on an area of pavers: along its outline, across it every 8 to 15 m, and along the
/// walls on it.
void add_bands(const GroundCover& cover, const world::Scenario& scenario, const GroundMap& map,
               GroundBuilder& builder);

/// Strips that blind people feel, at both ends of crossings.
void add_tactile_paving(const world::Scenario& scenario, const GroundMap& map,
                        GroundBuilder& builder);

/// Markings of the scenario, stop lines before its crossings, and the ends of parking bays around
/// cars on asphalt.
void add_paint(const world::Scenario& scenario, const GroundMap& map, GroundBuilder& builder);

}  // namespace throng::render
