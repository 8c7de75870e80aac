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

/// Bands of setts on an area of pavers: along its outline, across it every 8 to 15 m, and along the
/// walls on it; `height_m` is the area's.
void add_bands(const std::vector<Eigen::Vector2d>& corners, const world::Scenario& scenario,
               const GroundMap& map, double height_m, GroundBuilder& builder);

/// Strips that blind people feel, at both ends of crossings.
void add_tactile_paving(const world::Scenario& scenario, const GroundMap& map,
                        GroundBuilder& builder);

/// Markings of the scenario, stop lines before its crossings, and the ends of parking bays around
/// cars on asphalt.
void add_paint(const world::Scenario& scenario, const GroundMap& map, GroundBuilder& builder);

}  // namespace throng::render
