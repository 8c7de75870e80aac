// Football pitches: markings of the kind "pitch", whose goal lines are at their ends (Laws of the
// Game, law 1).
#pragma once

#include "render/ground/ground_builder.h"
#include "world/scenario.h"

namespace throng::render {

/// The lines of a pitch; arcs are polygons of sides below half a meter.
void add_pitch_lines(const world::Marking& pitch, GroundBuilder& builder);

/// Stripes across the pitches of a scenario, mown in two directions.
void add_mown_stripes(const world::Scenario& scenario, GroundBuilder& builder);

}  // namespace throng::render
