// The files of a baked population besides its GLBs.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "skinning/character.h"
#include "skinning/skeleton.h"

namespace throng::skinning {

/// Changes whenever the files mean something else, so that old ones are refused.
inline constexpr int kPopulationFormat = 4;
inline constexpr const char* kIndexFile = "population.json";
inline constexpr const char* kPalettesFile = "palettes.bin";

/// population.json.
struct PopulationIndex {
  std::string content_hash;  ///< of everything that the people were made from
  std::string license;       ///< SPDX expression
  int texture_size = 0;
  std::vector<Character> characters;  ///< without their levels, which are in <name>.glb
  std::vector<Clip> clips;
  std::uint32_t palettes_per_character = 0;
};

std::string encode_index(const PopulationIndex& index);

/// Throws InputError naming what is missing or malformed.
PopulationIndex read_index(const std::filesystem::path& folder);

/// One character of the index on its own.
inline constexpr const char* kCharacterExtension = ".character.json";
std::string encode_character(const Character& character);
Character read_character(const std::filesystem::path& path);

/// Throws InputError unless it is from 32 to 2048 pixels.
void check_texture_size(int pixels);

/// Throws InputError unless the folder is new, empty or holds character library: only a character
/// library is replaced for people.
void check_replaceable(const std::filesystem::path& folder);

/// The palettes of all characters, whose joints these are, one character after the other; see
/// packed.h. Throws InputError when the file is missing or does not hold `per_character` poses of
/// each.
std::vector<Palette> read_palettes(const std::filesystem::path& folder,
                                   const std::vector<Joints>& characters,
                                   std::size_t per_character);

}  // namespace throng::skinning
