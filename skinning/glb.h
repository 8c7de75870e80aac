// Characters as GLB files: skinned meshes with embedded PNG textures, Y up and facing +Z as glTF
// wants it. Written by us, read through assimp.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "skinning/character.h"
#include "skinning/skeleton.h"

namespace throng::skinning {

/// Contents of one file. The parts' textures count into `images`.
struct CharacterAsset {
  std::string name;
  Joints joints;                    ///< rest pose, model space
  std::vector<Mesh> levels;         ///< nodes "level0", "level1", ...
  std::vector<std::string> images;  ///< PNG files
};

std::string encode_glb(const CharacterAsset& asset);

/// Throws InputError naming the file when assimp cannot read it or when it is not such a character
/// (no levels, unknown bones, vertices without weights, images that are not PNG).
CharacterAsset read_glb(const std::filesystem::path& path);

}  // namespace throng::skinning
