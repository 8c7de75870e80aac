// Mesh files as triangles with colors.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "world/imports/parts/imported_scenario.h"

namespace throng::imports {

/// Reads what assimp does, z up: COLLADA and glTF files, which say or have to have their own up,
/// are turned; all others are taken as they are, as Gazebo does. Only the mesh `submesh`, unless
/// that is empty. Throws InputError for what is no mesh, has a coordinate that is no number, or
/// more than a million triangles.
std::vector<Solid> read_mesh(const std::filesystem::path& file, const std::string& submesh);

}  // namespace throng::imports
