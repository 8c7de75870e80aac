// The character library, the renderer's data of people. A library is built once at set-up
// (`throng people build`) and loaded from its folder. Independent of GL.
#pragma once

#include <filesystem>
#include <initializer_list>

#include "skinning/character.h"
#include "skinning/palettes.h"

namespace throng::skinning {

/// A character library.
struct Population {
  std::string content_hash;  ///< SHA-256 of all inputs of the build
  std::vector<Character> characters;
  int texture_size = 0;
  std::vector<Texture> textures;
  std::vector<Clip> clips;
  std::uint32_t palettes_per_character = 0;
  Palettes palettes;  ///< [character][palette]

  Palette palette(std::size_t character, std::size_t index) const {
    return palettes[character * palettes_per_character + index];
  }
};

/// Loads a character library. Throws InputError if a file is missing or malformed, naming the file
/// and a remedy.
Population load_population(const std::filesystem::path& folder);

/// The folder of the character library: $THRONG_PEOPLE if set, else the installed folder, else that
/// of the build tree.
std::filesystem::path population_folder();

/// Linear blend skinning as in the vertex shader: the sum of weights * (palette * position), with
/// the two palettes blended linearly before.
Eigen::Vector3f skin(const Vertex& vertex, const Palette& a, const Palette& b, float blend);

/// Whether the weights of these bones for a vertex sum to more than a half.
bool moves_mostly_with(const Vertex& vertex, std::initializer_list<Bone> bones);

}  // namespace throng::skinning
