// Characters of the user's own as members of a population: any rigged model that assimp reads,
// with a description (description.h).
#pragma once

#include <filesystem>
#include <vector>

#include "skinning/bake/builder.h"

namespace throng::skinning {

struct ImportOptions {
  std::filesystem::path with;  ///< folder of character library to put them among; empty for none
  int texture_size = 256;      ///< of the images, when there are no others; 32 to 2048
};

/// Writes a folder that load_population reads: the people of `options.with`, then the characters.
/// The folder appears complete or not at all; it may be the one that they are put among. Throws
/// InputError as import_character, or for two characters of one name; EnvironmentError when it
/// cannot be written.
void import_characters(const std::vector<std::filesystem::path>& descriptions,
                       const std::filesystem::path& output_folder, const ImportOptions& options,
                       const BuildProgress& progress = {});

}  // namespace throng::skinning
