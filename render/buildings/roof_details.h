// Installations on roofs: chimneys, dormers, skylights, solar panels, gutters on pitched ones,
// machines, domes of light, panels and masts on flat ones. Independent of GL.
#pragma once

#include <cstdint>

#include "render/buildings/building_mesh.h"
#include "render/props/prop_mesh.h"

namespace throng::render {

/// No detail is higher above a building's height (m).
inline constexpr double kMaxAboveRoofM = 2.6;

/// The details of a roof, with this id; they depend on the building's number and shape alone.
PropMesh roof_details(const BuildingModel& model, std::uint32_t id);

}  // namespace throng::render
