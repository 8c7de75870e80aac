// Relief of facades: cornices, courses, downpipes, balconies, steps, flower boxes, dishes and
// coolers, and on the ground floor shop signs with letters, awnings and blade signs.
// Independent of GL.
#pragma once

#include <cstdint>

#include "render/buildings/building_mesh.h"
#include "render/props/prop_mesh.h"
#include "world/scenario.h"

namespace throng::render {

/// The details of a building's fronts, with this id; what faces up, as awnings and ledges do, has
/// `top_id`. Ground floors beside exits have none.
PropMesh facade_details(const BuildingModel& model, const world::Scenario& scenario,
                        std::uint32_t id, std::uint32_t top_id);

}  // namespace throng::render
