// Import of Gazebo's worlds (SDF) as scenarios.
#pragma once

#include <filesystem>
#include <vector>

#include "places/imports/gazebo/sdf_options.h"
#include "places/imports/parts/imported_scenario.h"

namespace throng::imports {

/// Reads the first world of a file, or a model without a world, with included files from the
/// world's folder and `models` (nothing is downloaded, and no other file is read). Boxes,
/// cylinders, spheres, capsules, ellipsoids, planes and meshes are converted: upright shapes on the
/// ground with a height of 2 m or more become buildings, flat ones areas of ground, all others
/// objects that are rendered unchanged. Collision shapes between 0.2 and 2 m above the ground
/// become obstacles for people; lights become lamp posts. ImportedScenario::skipped lists the rest.
/// Throws InputError (file, line) if the file contains no world, and EnvironmentError.
ImportedScenario read_sdf(const std::filesystem::path& file, const SdfOptions& options);

}  // namespace throng::imports
