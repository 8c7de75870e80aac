// Characters as GLB files: skinned meshes with embedded PNG textures, Y up and facing +Z as in
// glTF. Files are read by assimp.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "skinning/character.h"
#include "skinning/skeleton.h"

namespace throng::skinning {

/// The content of a file. Part::texture is an index into `images`.
struct CharacterAsset {
  std::string name;
  Joints joints;                    ///< rest pose, model space
  std::vector<Mesh> levels;         ///< nodes "level0", "level1", ...
  std::vector<std::string> images;  ///< PNG files
};

std::string encode_glb(const CharacterAsset& asset);

/// Reads a file. Throws InputError naming the file if assimp cannot read it or it is not such a
/// character (no levels, unknown bones, vertices without weights, images that are not PNG).
CharacterAsset read_glb(const std::filesystem::path& path);

}  // namespace throng::skinning
