// The files of a character library except its GLBs.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "skinning/character.h"
#include "skinning/palettes.h"
#include "skinning/skeleton.h"

namespace throng::skinning {

/// Version of the format, which grows when the meaning of files changes, so that old files are
/// refused.
inline constexpr int kPopulationFormat = 4;
inline constexpr const char* kIndexFile = "population.json";
inline constexpr const char* kPalettesFile = "palettes.bin";
inline constexpr const char* kMeshExtension = ".glb";

/// The content of population.json.
struct PopulationIndex {
  std::string content_hash;  ///< SHA-256 of all inputs of the build
  std::string license;       ///< SPDX expression
  int texture_size = 0;
  /// Number of different textures of all characters; 0: unknown, as in libraries of before.
  std::int64_t textures = 0;
  std::vector<Character> characters;  ///< without their levels, which are in <name>.glb
  std::vector<Clip> clips;
  std::uint32_t palettes_per_character = 0;
};

std::string encode_index(const PopulationIndex& index);

/// Number of different textures in the files of characters, read for PopulationIndex::textures.
std::int64_t count_textures(const std::filesystem::path& folder,
                            const std::vector<Character>& characters);

/// Reads population.json. Throws InputError naming the missing or malformed member.
PopulationIndex read_index(const std::filesystem::path& folder);

/// Suffix of files with a single character of the index, during a build.
inline constexpr const char* kCharacterExtension = ".character.json";
std::string encode_character(const Character& character);
Character read_character(const std::filesystem::path& path);

/// Throws InputError unless `pixels` is in [32, 2048].
void check_texture_size(int pixels);

/// Throws InputError unless the folder does not exist, is empty or contains a character library, so
/// that no other files are overwritten.
void check_replaceable(const std::filesystem::path& folder);

/// Reads the palettes of all characters, in their order (packed.h); `characters` has their joints.
/// Throws InputError if the file is missing or does not contain `per_character` poses of each.
Palettes read_palettes(const std::filesystem::path& folder, const std::vector<Joints>& characters,
                       std::size_t per_character);

}  // namespace throng::skinning
