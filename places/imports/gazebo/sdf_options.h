// Options of the import of a Gazebo world.
#pragma once

#include <filesystem>
#include <vector>

#include "places/imports/parts/imported_scenario.h"

namespace throng::imports {

/// Options of read_sdf().
struct SdfOptions {
  std::vector<std::filesystem::path> models;  ///< folders in which model:// is resolved
  std::vector<Gate> gates;                    ///< exits; empty: openings of the edge
};

}  // namespace throng::imports
