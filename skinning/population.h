// The character library: the renderer's data of people. A population is baked once at set-up
// (`throng people build`) and loaded from its folder; nothing here touches GL.
#pragma once

#include <filesystem>
#include <initializer_list>

#include "skinning/character.h"

namespace throng::skinning {

/// Loads what `throng people build` wrote (GLB through assimp, palettes, textures). Throws
/// InputError when a file is missing or malformed, naming it and what would fix it.
Population load_population(const std::filesystem::path& folder);

/// Folder of the character library: $THRONG_PEOPLE if set, else the installed folder, else the
/// build tree's.
std::filesystem::path population_folder();

/// The skinning equation that the vertex shader runs too: sum of weights * (palette * position),
/// with the two palettes blended linearly first.
Eigen::Vector3f skin(const Vertex& vertex, const Palette& a, const Palette& b, float blend);

/// Whether these bones together move a vertex by more than a half.
bool moves_mostly_with(const Vertex& vertex, std::initializer_list<Bone> bones);

}  // namespace throng::skinning
