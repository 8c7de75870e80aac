// Reads robots described as SDF or URDF.
#pragma once

#include <filesystem>
#include <vector>

#include "places/imports/robots/robot.h"

namespace throng::imports {

/// Reads a robot: a model of SDF with what it includes from its own folder and `models` (folders in
/// which model:// and package:// are resolved), or URDF. Masses and inertias are summed over all
/// links at the joints' zero positions. Throws InputError (file, line or element) and
/// EnvironmentError.
Robot read_robot(const std::filesystem::path& file,
                 const std::vector<std::filesystem::path>& models);

}  // namespace throng::imports
