// The light of a place: bakes sky, lamps and the first two bounces into the corners of its
// triangles, cut where light varies, and into probes in the air.
#pragma once

#include <filesystem>

#include "render/light/probe_grid.h"
#include "render/scenery/daylight.h"
#include "render/scenery/place_meshes.h"
#include "spec/render/environment.h"
#include "spec/render/quality.h"
#include "world/scenario.h"

namespace throng::render {

/// Cuts the triangles of `meshes`, sets the light of all vertices, with the camera's exposure, and
/// returns that of the air. Independent of threads. `folder` holds the results for other processes
/// (render/light/light_store.h); empty: none does.
ProbeGrid light_place(const world::Scenario& scenario, const Environment& environment,
                      const Daylight& day, const QualitySettings& quality,
                      const std::filesystem::path& folder, PlaceMeshes& meshes);

/// The rays' scene of a place, built, from its uncut triangles.
void add_place(const PlaceMeshes& meshes, const world::Scenario& scenario,
               const Eigen::Array3f& lamp_color, RayScene& rays);

}  // namespace throng::render
