// Gazebo's worlds (SDF) as scenarios.
#pragma once

#include <filesystem>
#include <vector>

#include "world/imports/parts/imported_scenario.h"

namespace throng::imports {

struct SdfOptions {
  std::vector<std::filesystem::path> models;  ///< folders that model:// is looked for in
  std::vector<Gate> gates;                    ///< exits; empty: found at the edge
};

/// Reads the first world of a file, or a model that stands alone, with what it includes from the
/// world's folder and `models` (nothing is fetched, and no file elsewhere is read). Boxes,
/// cylinders, spheres, capsules, ellipsoids, planes and meshes at their poses: those that stand
/// upright on the ground and are 2 m high or more become buildings, flat ones areas of ground, all
/// others objects that are drawn as they are. Collisions between 0.2 and 2 m are obstacles for
/// people.
/// Lamps become lamp posts. The rest is listed in ImportedScenario::skipped. Throws InputError
/// (file, line) where there is no world in the file, and EnvironmentError.
ImportedScenario read_sdf(const std::filesystem::path& file, const SdfOptions& options);

}  // namespace throng::imports
