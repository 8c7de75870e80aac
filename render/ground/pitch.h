// Football pitches: markings of the kind "pitch", whose goal lines are at their ends (Laws of the
// Game, law 1).
#pragma once

#include <vector>

#include "render/ground/ground_builder.h"
#include "world/scenario.h"

namespace throng::render {

/// The middles of the lines of a pitch, in pieces of at most 4 m; arcs are polygons of sides below
/// half a meter.
std::vector<GroundSegment> pitch_lines(const world::Marking& pitch);

/// Whether a point lies on a pitch.
bool is_on_pitch(const world::Marking& pitch, const Eigen::Vector2d& point);

/// The lines of a pitch, as wide as they are.
void add_pitch_lines(const world::Marking& pitch, GroundBuilder& builder);

/// Stripes across the pitches of a scenario, mown in two directions.
void add_mown_stripes(const world::Scenario& scenario, GroundBuilder& builder);

}  // namespace throng::render
