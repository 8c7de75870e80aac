// Writes an imported scenario as files that can be loaded and run.
#pragma once

#include <filesystem>
#include <vector>

#include "places/imports/parts/imported_scenario.h"
#include "places/imports/parts/populate.h"

namespace throng::imports {

/// Writes into `folder`: NAME.json, NAME_scene.xml, NAME_behavior.xml, NAME.job.json (a short draft
/// job), NAME.skipped.txt and, if there are objects, NAME_meshes/. Each file is complete or absent;
/// the scenario's is written last. NAME is the scenario's name, which must consist of a to z, 0 to
/// 9 and '_'. Returns the scenario's file. Throws EnvironmentError.
std::filesystem::path write_imported_scenario(const ImportedScenario& scenario,
                                              const Population& population,
                                              const std::filesystem::path& folder);

/// Height (m) from which a drone sees the scenario, above all roofs.
double overview_height_m(const ImportedScenario& scenario);

}  // namespace throng::imports
