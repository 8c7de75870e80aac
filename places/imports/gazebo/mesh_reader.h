// Reads mesh files as colored triangles.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "places/imports/parts/imported_scenario.h"

namespace throng::imports {

/// Reads a mesh in any format of assimp, with z up: COLLADA and glTF files, which define an up
/// axis, are rotated; others are taken as they are, as in Gazebo. Reads only the mesh `submesh`
/// unless it is "". Throws InputError if the file is no mesh, has a coordinate that is not finite,
/// or more than a million triangles.
std::vector<Solid> read_mesh(const std::filesystem::path& file, const std::string& submesh);

}  // namespace throng::imports
