// Import of custom characters into a character library: rigged models in any format of assimp, with
// descriptions (description.h).
#pragma once

#include <filesystem>
#include <vector>

#include "skinning/bake/builder.h"

namespace throng::skinning {

/// Options of import_characters().
struct ImportOptions {
  std::filesystem::path with;  ///< folder of a character library to be extended; empty: none
  int texture_size = 256;      ///< pixels along each side, without `with`; 32 to 2048
};

/// Writes a character library with the characters of `options.with`, followed by the imported ones.
/// The folder is complete or absent; it may be `options.with` itself. Throws InputError as
/// import_character() and for duplicate names, and EnvironmentError if the folder cannot be
/// written.
void import_characters(const std::vector<std::filesystem::path>& descriptions,
                       const std::filesystem::path& output_folder, const ImportOptions& options,
                       const BuildProgress& progress = {});

}  // namespace throng::skinning
