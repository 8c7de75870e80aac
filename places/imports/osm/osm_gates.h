// Gates where ways leave an extract.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <utility>
#include <vector>

#include "places/imports/osm/osm_tags.h"
#include "places/imports/parts/imported_scenario.h"

namespace throng::imports {

/// A way that people or cars use.
struct UsedWay {
  const OsmLine* line;
  WayKind kind;
};

/// Makes a gate on the edge of `inside` wherever a way crosses the edge or ends within a meter of
/// it, with the width of the way (2 to 12 m). Overlapping gates are merged.
std::vector<Gate> gates_at_edge(const std::vector<UsedWay>& ways, const world::Rectangle& inside);

/// The part of a segment in a rectangle, or nothing if it is not longer than a decimeter (Liang and
/// Barsky, ACM Transactions on Graphics 3, 1984).
std::optional<std::pair<Eigen::Vector2d, Eigen::Vector2d>> part_within(
    const Eigen::Vector2d& from, const Eigen::Vector2d& to, const world::Rectangle& area);

}  // namespace throng::imports
